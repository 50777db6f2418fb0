// SPDX-License-Identifier: BSD-3-Clause
#include "io/provenance.hpp"

#include <charconv>
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

struct NamedNumber {
  const char* name;
  double FileCertificate::*value;
};
constexpr NamedNumber kCertificate[] = {
    {"delos_well_centred", &FileCertificate::well_centred},
    {"delos_min_relative_edge", &FileCertificate::min_relative_edge},
    {"delos_min_dual_ratio", &FileCertificate::min_dual_ratio}};

struct NamedText {
  const char* name;
  std::string Provenance::*value;
};
constexpr NamedText kTexts[] = {{"history", &Provenance::history},
                                {"delos_version", &Provenance::version},
                                {"delos_config", &Provenance::config},
                                {"delos_digest", &Provenance::digest}};

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

void write_provenance(netcdf::Writer& file, const Provenance& provenance) {
  for (const NamedText& item : kTexts) {
    const std::string& value = provenance.*item.value;
    if (!value.empty()) file.attribute(netcdf::kGlobal, item.name, value);
  }
  std::string inputs;
  for (const InputFile& input : provenance.inputs) {
    inputs += (inputs.empty() ? "" : "\n") + input.sha256 + "  " + input.path;
  }
  if (!inputs.empty()) file.attribute(netcdf::kGlobal, "delos_inputs", inputs);
  if (!provenance.certificate) return;
  for (const NamedNumber& item : kCertificate) {
    file.attribute(netcdf::kGlobal, item.name, (*provenance.certificate).*item.value);
  }
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
  FileCertificate certificate;
  bool complete = true;
  for (const NamedNumber& item : kCertificate) {
    const auto value = file.number_attribute("", item.name);
    complete = complete && value && value->size() == 1;
    if (complete) certificate.*item.value = value->front();
  }
  if (complete) provenance.certificate = certificate;
  return provenance;
}

}  // namespace delos
