// SPDX-License-Identifier: BSD-3-Clause
// Animated PNG: the frames' compressed pixels stay as they are, their chunks get other names and
// numbers (https://www.w3.org/TR/png-3/, sections 5 and 11.3.6).
#include <array>
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "picture.hpp"

namespace shallow_water {
namespace {

constexpr std::size_t kSignature = 8;  // bytes before the first chunk

std::string big_endian(std::uint32_t value) {
  std::string bytes;
  for (int shift = 24; shift >= 0; shift -= 8) bytes += static_cast<char>(value >> shift & 0xFFU);
  return bytes;
}

std::uint32_t number_at(const std::string& bytes, std::size_t place) {
  std::uint32_t value = 0;
  for (std::size_t i = 0; i < 4; ++i) {
    value = value << 8U | static_cast<unsigned char>(bytes[place + i]);
  }
  return value;
}

// Annex D there: the remainder by the polynomial of CRC-32, lowest bit first.
std::uint32_t checksum(const std::string& bytes) {
  std::uint32_t rest = ~0U;
  for (const char each : bytes) {
    rest ^= static_cast<unsigned char>(each);
    for (int bit = 0; bit < 8; ++bit)
      rest = (rest & 1U) != 0 ? rest >> 1U ^ 0xEDB88320U : rest >> 1U;
  }
  return ~rest;
}

std::string chunk(const std::string& name, const std::string& data) {
  return big_endian(static_cast<std::uint32_t>(data.size())) + name + data +
         big_endian(checksum(name + data));
}

// The data of all chunks of this name, one after the other.
std::string data_of(const std::string& png, const std::string& name) {
  std::string data;
  for (std::size_t place = kSignature; place + 12 <= png.size();) {
    const std::size_t length = number_at(png, place);
    if (png.compare(place + 4, 4, name) == 0) data += png.substr(place + 8, length);
    place += length + 12;
  }
  return data;
}

}  // namespace

std::string animate(const std::vector<std::string>& pictures) {
  if (pictures.empty()) return {};
  const std::string header = data_of(pictures.front(), "IHDR");
  const std::string size = header.substr(0, 8);  // width and height
  const std::string nowhere(8, '\0');            // offsets of the frame
  // 1 / 5 of a second; the frame stays, and replaces the one before.
  const std::string manner = {0, 1, 0, 5, 0, 0};
  std::string file =
      pictures.front().substr(0, kSignature) + chunk("IHDR", header) +
      chunk("acTL", big_endian(static_cast<std::uint32_t>(pictures.size())) + big_endian(0));
  std::uint32_t number = 0;
  for (const std::string& picture : pictures) {
    const bool is_first = number == 0;
    std::string control = big_endian(number++);
    control.append(size).append(nowhere).append(manner);
    file += chunk("fcTL", control);
    const std::string pixels = data_of(picture, "IDAT");
    file += is_first ? chunk("IDAT", pixels) : chunk("fdAT", big_endian(number++) + pixels);
  }
  return file + chunk("IEND", "");
}

}  // namespace shallow_water
