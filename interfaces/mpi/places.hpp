// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Values of some components at each place, as messages.
#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "communicator.hpp"

namespace delos::mpi {

/// Throws Error(input) unless `size` is one of two counts of places, times components.
inline void check_size(std::size_t size, int n_components, std::array<std::size_t, 2> counts) {
  const auto per_place = static_cast<std::size_t>(std::max(n_components, 0));
  if (n_components >= 1 && (size == counts[0] * per_place || size == counts[1] * per_place)) return;
  std::string places = std::to_string(counts[0]);
  if (counts[1] != counts[0]) places += " or " + std::to_string(counts[1]);
  throw Error(ErrorKind::input, "the field has " + std::to_string(size) + " values, but " + places +
                                    " places of " + std::to_string(n_components) +
                                    " components: give them all, and n_components >= 1.");
}

/// The components of one place as one MPI element, so that counts are counts of places.
class PlaceType {
 public:
  PlaceType(std::size_t bytes_per_number, int n_components) {
    check(MPI_Type_contiguous(static_cast<int>(bytes_per_number) * n_components, MPI_BYTE, &type_),
          "MPI_Type_contiguous");
    check(MPI_Type_commit(&type_), "MPI_Type_commit");
  }
  ~PlaceType() { MPI_Type_free(&type_); }
  PlaceType(const PlaceType&) = delete;
  PlaceType& operator=(const PlaceType&) = delete;
  MPI_Datatype get() const { return type_; }

 private:
  MPI_Datatype type_ = MPI_DATATYPE_NULL;
};

/// The values of these places, one after the other.
template <class Number>
std::vector<Number> picked(std::span<const Number> values, std::span<const std::int32_t> places,
                           int n_components) {
  const auto width = static_cast<std::size_t>(n_components);
  std::vector<Number> out(places.size() * width);
  for (std::size_t i = 0; i < places.size(); ++i) {
    std::copy_n(values.begin() + static_cast<std::ptrdiff_t>(places[i]) * n_components, width,
                out.begin() + static_cast<std::ptrdiff_t>(i * width));
  }
  return out;
}

/// And back.
template <class Number>
void put(std::span<const Number> from, std::span<const std::int32_t> places, int n_components,
         std::span<Number> to) {
  const auto width = static_cast<std::size_t>(n_components);
  for (std::size_t i = 0; i < places.size(); ++i) {
    std::copy_n(from.begin() + static_cast<std::ptrdiff_t>(i * width), width,
                to.begin() + static_cast<std::ptrdiff_t>(places[i]) * n_components);
  }
}

}  // namespace delos::mpi
