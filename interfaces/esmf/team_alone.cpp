// SPDX-License-Identifier: BSD-3-Clause
#include <string>

#include "team.hpp"

namespace delos::cap {
namespace {

class Alone : public Team {
 public:
  bool is_first() const override { return true; }
  LocalGrid spread(const std::function<Grid()>& make) override {
    return Partition(make(), {.n_parts = 1, .method = PartitionMethod::curve}).part(0);
  }
  double shared(double value) override { return value; }
  std::vector<double> gather(std::span<const double> own) override {
    return {own.begin(), own.end()};
  }
  std::vector<double> scatter(std::span<const double> whole) override {
    return {whole.begin(), whole.end()};
  }
  void together(const std::function<void()>& body) override { body(); }
};

}  // namespace

std::unique_ptr<Team> make_team(int /*communicator*/, int n_processes) {
  if (n_processes != 1) {
    throw Error(ErrorKind::config, "the component has " + std::to_string(n_processes) +
                                       " processes, but this delos was built without MPI: build "
                                       "it with -DDELOS_MPI=ON, or give the component one");
  }
  return std::make_unique<Alone>();
}

}  // namespace delos::cap
