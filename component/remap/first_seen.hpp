// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Numbers the ids of a small neighbourhood as they come.
#include <algorithm>
#include <cstdint>
#include <utility>
#include <vector>

#include "core/types.hpp"

namespace delos::remap {

/// Ids in the order in which they were first seen, found again by hashing. Keeps its memory from
/// one neighbourhood to the next; one for each task.
class FirstSeen {
 public:
  void clear() {
    std::fill(slots_.begin(), slots_.end(), Slot{kNone, 0});
    ids_.clear();
  }
  /// Place of the id among ids(); it is put there the first time.
  std::size_t place_of(Index id) {
    if (2 * (ids_.size() + 1) > slots_.size()) grow();
    Slot& slot = slot_of(id);
    if (slot.id == kNone) {
      slot = {id, static_cast<Index>(ids_.size())};
      ids_.push_back(id);
    }
    return at(slot.place);
  }
  const std::vector<Index>& ids() const { return ids_; }

 private:
  struct Slot {
    Index id, place;
  };
  // Where the id is or would be.
  Slot& slot_of(Index id) {
    const std::size_t mask = slots_.size() - 1;
    std::size_t slot = (static_cast<std::uint32_t>(id) * 2654435769U >> 7) & mask;
    while (slots_[slot].id != kNone && slots_[slot].id != id) slot = (slot + 1) & mask;
    return slots_[slot];
  }
  void grow() {
    slots_.assign(2 * slots_.size(), Slot{kNone, 0});
    for (std::size_t k = 0; k < ids_.size(); ++k) {
      slot_of(ids_[k]) = {ids_[k], static_cast<Index>(k)};
    }
  }
  std::vector<Slot> slots_ = std::vector<Slot>(32, Slot{kNone, 0});
  std::vector<Index> ids_;
};

}  // namespace delos::remap
