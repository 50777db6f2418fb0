// SPDX-License-Identifier: BSD-3-Clause
#include "io/provenance.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstdlib>
#include <fstream>
#include <sstream>

#include "core/error.hpp"
#include "core/hash.hpp"

namespace delos {
namespace {

// Civil date of a day count since 1970-01-01 (Hinnant, "chrono-compatible low-level date
// algorithms"): the C library's gmtime is not thread safe, std::format is not there in GCC 12.
struct Date {
  std::int64_t year;
  int month, day;
};

Date civil_date(std::int64_t days) {
  constexpr std::int64_t kDaysPerEra = 146097;  // 400 years
  days += 719468;                               // from 0000-03-01
  const std::int64_t era = (days >= 0 ? days : days - (kDaysPerEra - 1)) / kDaysPerEra;
  const std::int64_t doe = days - era * kDaysPerEra;
  const std::int64_t yoe = (doe - doe / 1460 + doe / 36524 - doe / 146096) / 365;
  const std::int64_t doy = doe - (365 * yoe + yoe / 4 - yoe / 100);
  const std::int64_t shifted = (5 * doy + 2) / 153;
  const int day = static_cast<int>(doy - (153 * shifted + 2) / 5 + 1);
  const int month = static_cast<int>(shifted < 10 ? shifted + 3 : shifted - 9);
  return {yoe + era * 400 + (month <= 2 ? 1 : 0), month, day};
}

std::string two_digits(std::int64_t value) {
  return std::string(value < 10 ? "0" : "") + std::to_string(value);
}

constexpr char kStatement[] = "delos_certificate";
constexpr char kWellCentred[] = "delos_well_centred";
constexpr char kObtuse[] = "delos_n_obtuse";
constexpr char kAngle[] = "delos_angle_max_deg";
constexpr char kDualRatio[] = "delos_dual_ratio_min";
constexpr char kStagger[] = "delos_stagger_max";
constexpr char kRelativeEdge[] = "delos_relative_edge_min";
constexpr const char* kNumbers[] = {kWellCentred, kObtuse,  kAngle,
                                    kDualRatio,   kStagger, kRelativeEdge};
constexpr std::int32_t kIndexBase = 1;  // of every table in MPAS and in our UGRID

struct NamedText {
  const char* name;
  std::string Provenance::*value;
};
constexpr NamedText kTexts[] = {{"history", &Provenance::history},
                                {"delos_version", &Provenance::version},
                                {"delos_config", &Provenance::config},
                                {"delos_digest", &Provenance::digest}};

const char* ids_suffix(std::size_t n_ids) { return n_ids == 1 ? "_triangle" : "_cells"; }

void write_extreme(netcdf::Writer& file, const std::string& name, const FileExtreme& extreme,
                   std::size_t n_ids) {
  DELOS_CHECK(std::isfinite(extreme.value) && std::isfinite(extreme.lon_lat_deg[0]) &&
                  std::isfinite(extreme.lon_lat_deg[1]),
              ErrorKind::internal, "attribute ", name, " of ", file.path(), " would be ",
              extreme.value, ": a certificate holds finite numbers only.");
  file.attribute(netcdf::kGlobal, name, extreme.value);
  const std::array<std::int32_t, 2> ids = {extreme.ids[0] + kIndexBase,
                                           extreme.ids[1] + kIndexBase};
  file.attribute(netcdf::kGlobal, name + ids_suffix(n_ids), std::span(ids.data(), n_ids));
  file.attribute(netcdf::kGlobal, name + "_lon_lat", std::span<const double>(extreme.lon_lat_deg));
}

void write_certificate(netcdf::Writer& file, const FileCertificate& certificate,
                       const ElementNames& elements) {
  file.attribute(
      netcdf::kGlobal, kStatement,
      text("ids count from ", kIndexBase, "; *_triangle along ", elements.triangle,
           ", *_cells (the two cells of an edge) along ", elements.cell, "; *_lon_lat in degrees"));
  file.attribute(netcdf::kGlobal, kWellCentred, certificate.well_centred);
  file.attribute(netcdf::kGlobal, kObtuse, certificate.n_obtuse);
  write_extreme(file, kAngle, certificate.angle_max_deg, 1);
  if (certificate.relative_edge_min) {
    write_extreme(file, kRelativeEdge, *certificate.relative_edge_min, 2);
  }
  write_extreme(file, kDualRatio, certificate.dual_ratio_min, 2);
  write_extreme(file, kStagger, certificate.stagger_max, 2);
}

/// A global attribute of n finite numbers.
std::vector<double> numbers(const netcdf::Reader& file, const std::string& name, std::size_t n) {
  const auto values = file.number_attribute("", name);
  const bool is_good = values && values->size() == n &&
                       std::all_of(values->begin(), values->end(),
                                   [](double value) { return std::isfinite(value); });
  DELOS_CHECK(is_good, ErrorKind::input, file.path(), ": attribute ", name, " ",
              values ? "is not" : "is missing; it must be", " ", n,
              n == 1 ? " finite number" : " finite numbers",
              ", as the rest of the certificate is there. The file was changed; make it anew.");
  return *values;
}

FileExtreme read_extreme(const netcdf::Reader& file, const std::string& name, std::size_t n_ids) {
  FileExtreme out;
  out.value = numbers(file, name, 1).front();
  const std::string ids_name = name + ids_suffix(n_ids);
  const std::vector<double> ids = numbers(file, ids_name, n_ids);
  constexpr double kElsewhere = 0.0;  // an element of the triangulation that a culled grid lacks
  for (std::size_t i = 0; i < n_ids; ++i) {
    const double id = ids[i];
    constexpr double kMost = 2147483647.0;
    DELOS_CHECK(id >= kElsewhere && id <= kMost && id == std::floor(id), ErrorKind::input,
                file.path(), ": attribute ", ids_name, " holds ", id,
                ", which is no id from 1. The file was changed; make it anew.");
    out.ids[i] = static_cast<Index>(id) - kIndexBase;
  }
  const std::vector<double> place = numbers(file, name + "_lon_lat", 2);
  out.lon_lat_deg = {place[0], place[1]};
  return out;
}

std::optional<FileCertificate> read_certificate(const netcdf::Reader& file) {
  const bool has_any = file.text_attribute("", kStatement).has_value() ||
                       std::any_of(std::begin(kNumbers), std::end(kNumbers), [&](const char* name) {
                         return file.number_attribute("", name).has_value();
                       });
  if (!has_any) return std::nullopt;
  FileCertificate out;
  out.well_centred = numbers(file, kWellCentred, 1).front();
  out.n_obtuse =
      static_cast<std::int32_t>(std::clamp(numbers(file, kObtuse, 1).front(), -1.0, 2e9));
  out.angle_max_deg = read_extreme(file, kAngle, 1);
  out.dual_ratio_min = read_extreme(file, kDualRatio, 2);
  out.stagger_max = read_extreme(file, kStagger, 2);
  if (file.number_attribute("", kRelativeEdge)) {
    out.relative_edge_min = read_extreme(file, kRelativeEdge, 2);
  }
  return out;
}

}  // namespace

InputFile describe_input(const std::string& path) {
  std::ifstream file(path, std::ios::binary);
  DELOS_CHECK(file.good(), ErrorKind::input, "can't read ", path,
              " to take its checksum. Check the path and its permissions.");
  Digest digest;
  std::vector<char> buffer(std::size_t{1} << 20);
  do {
    file.read(buffer.data(), static_cast<std::streamsize>(buffer.size()));
    digest.add(buffer.data(), static_cast<std::size_t>(file.gcount()));
  } while (file);
  DELOS_CHECK(file.eof(), ErrorKind::input, "reading ", path,
              " for its checksum stopped half way. Check the disk and that it is a file.");
  return {path, digest.hex()};
}

std::int64_t history_time(std::int64_t now_s) {
  const char* fixed = std::getenv("SOURCE_DATE_EPOCH");
  if (fixed == nullptr || *fixed == '\0') return now_s;
  const std::string value(fixed);
  std::int64_t time_s = -1;
  const auto [end, failed] = std::from_chars(value.data(), value.data() + value.size(), time_s);
  DELOS_CHECK(failed == std::errc() && end == value.data() + value.size() && time_s >= 0,
              ErrorKind::config, "environment variable SOURCE_DATE_EPOCH = '", value,
              "': must be a whole number of seconds >= 0. Set it right, or unset it.");
  return time_s;
}

std::string history_line(std::int64_t time_s, const std::string& command) {
  constexpr std::int64_t kDay = 86400;
  const std::int64_t second = ((time_s % kDay) + kDay) % kDay;
  const Date date = civil_date((time_s - second) / kDay);
  return text(date.year, "-", two_digits(date.month), "-", two_digits(date.day), "T",
              two_digits(second / 3600), ":", two_digits(second / 60 % 60), ":",
              two_digits(second % 60), "Z: ", command);
}

std::string file_id(const std::string& digest) {
  constexpr char kAlphabet[] = "0123456789abcdefghijklmnopqrstuvwxyz";
  constexpr std::uint64_t kLetters = sizeof(kAlphabet) - 1;
  std::uint64_t state = digest.size();
  for (const char c : digest) state = hash64(state, static_cast<unsigned char>(c));
  std::string id;
  for (std::uint64_t i = 0; i < 10; ++i) id += kAlphabet[hash64(state, i, 1) % kLetters];
  return id;
}

void write_provenance(netcdf::Writer& file, const Provenance& provenance,
                      const ElementNames& elements) {
  for (const NamedText& item : kTexts) {
    const std::string& value = provenance.*item.value;
    if (!value.empty()) file.attribute(netcdf::kGlobal, item.name, value);
  }
  std::string inputs;
  for (const InputFile& input : provenance.inputs) {
    inputs += (inputs.empty() ? "" : "\n") + input.sha256 + "  " + input.path;
  }
  if (!inputs.empty()) file.attribute(netcdf::kGlobal, "delos_inputs", inputs);
  if (provenance.certificate) write_certificate(file, *provenance.certificate, elements);
}

Provenance read_provenance(const netcdf::Reader& file) {
  Provenance provenance;
  for (const NamedText& item : kTexts) {
    provenance.*item.value = file.text_attribute("", item.name).value_or("");
  }
  std::istringstream inputs(file.text_attribute("", "delos_inputs").value_or(""));
  constexpr std::size_t kHexDigits = 64;
  for (std::string line; std::getline(inputs, line);) {
    if (line.size() < kHexDigits + 2) continue;
    provenance.inputs.push_back({line.substr(kHexDigits + 2), line.substr(0, kHexDigits)});
  }
  provenance.certificate = read_certificate(file);
  return provenance;
}

}  // namespace delos
