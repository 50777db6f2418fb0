// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Where input files are looked for.
#include <span>
#include <string>

namespace delos {

/// Where Debian's ferret-datasets puts etopo5.cdf, levitus_climatology.cdf and others.
inline constexpr const char* kDefaultDataFolder = "/usr/share/ferret-vis/data";

/// An absolute `name` as it is; else the first file that exists of folder/name and then, for each
/// entry of data_path in order, entry/name (a relative entry counts from `folder`, too; an empty
/// `folder` is the current one). Error(input) lists the places looked at and the Debian package
/// that has the file, if one has.
std::string find_data_file(const std::string& name, const std::string& folder,
                           std::span<const std::string> data_path);

/// Whether find_data_file would find it.
bool has_data_file(const std::string& name, const std::string& folder,
                   std::span<const std::string> data_path);

}  // namespace delos
