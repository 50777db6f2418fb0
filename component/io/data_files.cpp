// SPDX-License-Identifier: BSD-3-Clause
#include "io/data_files.hpp"

#include <algorithm>
#include <array>
#include <filesystem>
#include <optional>
#include <vector>

#include "core/error.hpp"
#include "io/names.hpp"

namespace delos {
namespace {

namespace fs = std::filesystem;

struct PackagedFile {
  const char* name;
  const char* package;
};
constexpr std::array<PackagedFile, 10> kPackagedFiles = {
    {{"etopo5.cdf", "ferret-datasets"},
     {"etopo20.cdf", "ferret-datasets"},
     {"etopo40.cdf", "ferret-datasets"},
     {"etopo60.cdf", "ferret-datasets"},
     {"etopo120.cdf", "ferret-datasets"},
     {"levitus_climatology.cdf", "ferret-datasets"},
     {"monthly_navy_winds.cdf", "ferret-datasets"},
     {"coads_climatology.cdf", "ferret-datasets"},
     {"esku_heat_budget.cdf", "ferret-datasets"},
     {"ocean_atlas_subset.nc", "ferret-datasets"}}};

std::vector<fs::path> places(const std::string& name, const std::string& folder,
                             std::span<const std::string> data_path) {
  if (fs::path(name).is_absolute()) return {name};
  std::vector<fs::path> candidates = {fs::path(folder) / name};
  for (const std::string& entry : data_path) candidates.push_back(fs::path(folder) / entry / name);
  return candidates;
}

std::optional<fs::path> first_existing(const std::vector<fs::path>& candidates) {
  const auto found = std::find_if(candidates.begin(), candidates.end(), [](const fs::path& path) {
    std::error_code error;  // a folder that may not be entered counts as not there
    return fs::is_regular_file(path, error);
  });
  if (found == candidates.end()) return std::nullopt;
  return *found;
}

/// "./h.nc is a folder. " when that is why it was passed over.
std::string passed_over(const std::vector<fs::path>& candidates) {
  for (const fs::path& path : candidates) {
    std::error_code error;
    const fs::file_status status = fs::status(path, error);
    if (!fs::exists(status)) continue;
    return text(path.string(), fs::is_directory(status) ? " is a folder. " : " is no plain file. ");
  }
  return "";
}

std::string package_hint(const std::string& name) {
  const std::string file = fs::path(name).filename().string();
  for (const PackagedFile& packaged : kPackagedFiles) {
    if (file == packaged.name) {
      return text("The Debian package ", packaged.package, " has it, in ", kDefaultDataFolder,
                  ": install it, or name the file's folder in `data_path`.");
    }
  }
  return "Check the name, or name the file's folder in `data_path`.";
}

}  // namespace

std::string find_data_file(const std::string& name, const std::string& folder,
                           std::span<const std::string> data_path) {
  DELOS_CHECK(!name.empty(), ErrorKind::config, "the name of an input file is empty. Give one.");
  const std::vector<fs::path> candidates = places(name, folder, data_path);
  if (const auto found = first_existing(candidates)) return found->string();
  std::vector<std::string> looked;
  looked.reserve(candidates.size());
  for (const fs::path& path : candidates) looked.push_back(path.string());
  throw Error(ErrorKind::input, text(name, ": no such file. Looked for: ", join_names(looked), ". ",
                                     passed_over(candidates), package_hint(name)));
}

bool has_data_file(const std::string& name, const std::string& folder,
                   std::span<const std::string> data_path) {
  return !name.empty() && first_existing(places(name, folder, data_path)).has_value();
}

}  // namespace delos
