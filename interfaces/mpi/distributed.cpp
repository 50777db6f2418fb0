// SPDX-License-Identifier: BSD-3-Clause
#include "delos/distributed.hpp"

#include <algorithm>
#include <array>
#include <utility>

#include "distribution.hpp"
#include "items.hpp"

namespace delos::mpi {
namespace {

/// The collective calls, which all processes must make in the same order.
enum class Call : std::int64_t {
  advertise,
  realize,
  initialize,
  run,
  write_restart,
  read_restart,
  finalize,
  transfer,
  transfer_velocity,
  none
};

constexpr std::array kCalls = {"initialize(advertise)",
                               "initialize(realize)",
                               "initialize",
                               "run",
                               "write_restart",
                               "read_restart",
                               "finalize",
                               "transfer",
                               "transfer_velocity",
                               "something with arguments that can't be used"};

/// Where a clock is and goes, as plain integers.
std::vector<std::int64_t> step_of(const Clock& clock) {
  std::vector<std::int64_t> out{static_cast<std::int64_t>(clock.current().calendar())};
  for (const Time& time : {clock.current(), clock.next()}) {
    const DateTime at = time.date_time();
    out.insert(out.end(), {at.year, at.month, at.day, at.hour, at.minute, at.second, at.numerator,
                           at.denominator});
  }
  return out;
}

}  // namespace

struct DistributedComponent::Impl {
  Impl(MPI_Comm communicator, const std::function<Config()>& configure, const Options& of_host)
      : team(std::make_shared<const Communicator>(communicator)), options(of_host) {
    check_options(*team, options);
    options.generate = allowed(options.generate);
    team->together([&] {
      if (is_root()) serial.emplace(configure(), options.generate);
    });
  }

  std::shared_ptr<const Communicator> team;
  Options options;
  std::optional<Component> serial;  // the root's
  std::vector<Item> imports, exports;
  std::vector<FieldInfo> import_infos, export_infos;
  std::optional<DistributedGrid> parts;
  std::int64_t generation = 0;
  std::optional<Time> time;
  std::string decision, failure;

  // Of the run that made the parts, until the next one.
  std::optional<DistributedGrid> former_parts;
  std::optional<Grid> former_grid;           // the root's
  mutable std::optional<Transfer> transfer;  // the root's, once it was asked for

  bool is_root() const { return team->rank() == options.root; }

  /// body() on the root; all throw what it throws.
  template <class Body>
  void on_root(Body&& body) const {
    team->together([&] {
      if (is_root()) body();
    });
  }

  Communicator::Range called_by_all(Call call) const {
    const std::array number{static_cast<std::int64_t>(call)};
    return team->range(number);
  }

  void enter(Call call) const {
    const Communicator::Range called = called_by_all(call);
    if (called.is_same_everywhere()) return;
    const auto name = [](std::int64_t of) { return kCalls.at(static_cast<std::size_t>(of)); };
    refuse(std::string("the processes called ") + name(called.least[0]) + " and " +
           name(called.greatest[0]) + " at the same time: call the same on all, in one order.");
  }

  /// For calls that need the parts: without them the root's component is asked, which says what
  /// is expected; it has a grid only when that could not be handed out.
  template <class Refused>
  void need_parts(Call call, Refused&& refused) const {
    if (parts) return;
    on_root([&] {
      if (serial->generation() == 0) refused();
      refuse(std::string(kCalls.at(static_cast<std::size_t>(call))) +
             " was called on a component whose grid was made, but not handed out: see the former "
             "error; expected: finalize.");
    });
  }

  /// `if_first`: a component that is realized already stays as it is.
  void advertise(bool if_first = false) {
    on_root([&] {
      const bool is_realized = serial->generation() > 0 && !serial->current_time();
      if (!if_first || !is_realized) serial->initialize(InitializePhase::advertise);
    });
    if (!imports.empty() || !exports.empty()) return;
    std::string import_list, export_list;
    on_root([&] {
      import_list = list_of(serial->import_state());
      export_list = list_of(serial->export_state());
    });
    team->broadcast(import_list, options.root);
    team->broadcast(export_list, options.root);
    imports = items_of(import_list);
    exports = items_of(export_list);
    for (const Item& item : imports) import_infos.push_back(item.info);
    for (const Item& item : exports) export_infos.push_back(item.info);
  }

  void realize() {
    on_root([&] { serial->initialize(InitializePhase::realize); });
    if (!parts) hand_out();
  }

  /// The root's grid to all, with the exports.
  void hand_out() {
    parts.reset();
    generation = 0;
    for (Item& item : imports) item = {item.info, {}, false};
    parts = Distribution::make(
        team, [&] { return serial->grid(); }, options);
    try {
      share_exports(true);
    } catch (...) {
      parts.reset();
      throw;
    }
    generation = parts->generation();
  }

  /// Exports of cells, edges and vertices change with the grid only.
  void share_exports(bool is_new_grid) {
    std::vector<std::span<const double>> whole(exports.size());
    on_root([&] {
      for (std::size_t i = 0; i < exports.size(); ++i) {
        whole[i] = serial->export_state().field(exports[i].info.name).data();
      }
    });
    for (std::size_t i = 0; i < exports.size(); ++i) {
      Item& item = exports[i];
      if (is_spread(item.info.location)) {
        if (!is_new_grid) continue;
        item.values = parts->scatter(whole[i], item.info.location, item.info.n_components);
      } else {
        auto n = static_cast<std::int64_t>(whole[i].size());
        team->broadcast(std::span(&n, 1), options.root);
        item.values.assign(whole[i].begin(), whole[i].end());
        item.values.resize(static_cast<std::size_t>(n));
        team->broadcast(item.values, options.root);
      }
    }
  }

  /// The clocks agree, and every import was given whole or by nobody.
  void check_run(const Clock& clock) const {
    std::vector<std::int64_t> mine;
    team->together([&] {
      mine = step_of(clock);
      for (const Item& item : imports) {
        mine.push_back(item.is_given ? 1 : 0);
        if (item.is_given) check_import(item);
      }
    });
    const Communicator::Range all = team->range(mine);
    const std::size_t n_step = mine.size() - imports.size();
    for (std::size_t i = 0; i < mine.size(); ++i) {
      if (all.least[i] == all.greatest[i]) continue;
      if (i < n_step) {
        refuse("the clocks of the processes stand or go differently: give the same on all.");
      }
      throw Error(ErrorKind::input, "import field " + imports[i - n_step].info.name +
                                        " was given on some processes only: give the owned values "
                                        "on all of them, or on none.");
    }
  }

  void check_import(const Item& item) const {
    if (!is_spread(item.info.location)) {
      refuse("import field " + item.info.name +
             " is not spread over the processes: give it to whole_imports() on the root.");
    }
    const std::int64_t n_owned = parts->local().n_owned(item.info.location);
    if (static_cast<std::int64_t>(item.values.size()) == n_owned * item.info.n_components) return;
    throw Error(ErrorKind::input,
                "import field " + item.info.name + ": process " + std::to_string(team->rank()) +
                    " gave " + std::to_string(item.values.size()) + " values, needs " +
                    std::to_string(n_owned) + " x " + std::to_string(item.info.n_components) +
                    " (owned " + to_string(item.info.location) + "s, generation " +
                    std::to_string(generation) + ")");
  }

  /// Owned values of all to the root's component.
  void gather_imports(const Time& now) {
    for (Item& item : imports) {
      if (!item.is_given) continue;
      const auto whole = parts->gather(item.values, item.info.location, item.info.n_components);
      on_root([&] {
        Field field = serial->import_state().field(item.info.name);
        field.store(whole);
        field.stamp(now);
      });
      item.is_given = false;
      item.values = {};
    }
  }

  /// Whether the root's grid is another one now; then the parts are as well.
  bool follow_root() {
    std::int64_t now = 0;
    if (is_root()) {
      now = serial->generation();
      decision = serial->remesh_decision();
      failure = serial->remesh_failure();
    }
    team->broadcast(std::span(&now, 1), options.root);
    team->broadcast(decision, options.root);
    team->broadcast(failure, options.root);
    if (now == generation) {
      share_exports(false);
      former_grid.reset();
      return false;
    }
    former_parts = std::move(parts);
    hand_out();
    return true;
  }

  void forget_former() {
    former_parts.reset();
    former_grid.reset();
    transfer.reset();
  }

  void need_former(Call call) const {
    if (former_parts && parts) return;
    refuse(std::string(kCalls.at(static_cast<std::size_t>(call))) +
           " was called, but the last run made no new grid: fields need none.");
  }

  /// carry(transfer, from, to) on the root, between values of all.
  template <class Carry>
  std::vector<double> carried(std::span<const double> former, Location location, int n_levels,
                              Carry&& carry) const {
    const auto from = former_parts->gather(former, location, n_levels);
    std::vector<double> to;
    on_root([&] {
      if (!transfer) transfer.emplace(*former_grid, serial->grid(), options.generate);
      to.resize(static_cast<std::size_t>(parts->local().n_global(location)) *
                static_cast<std::size_t>(n_levels));
      carry(*transfer, from, to);
    });
    return parts->scatter(to, location, n_levels);
  }
};

void Distribution::pass_over(const DistributedComponent& component) {
  static_cast<void>(component.impl_->called_by_all(Call::none));
}

DistributedComponent::DistributedComponent(MPI_Comm communicator,
                                           const std::function<Config()>& configure,
                                           const Options& options)
    : impl_(std::make_unique<Impl>(communicator, configure, options)) {}
DistributedComponent::DistributedComponent(DistributedComponent&& other) noexcept = default;
DistributedComponent& DistributedComponent::operator=(DistributedComponent&& other) noexcept =
    default;
DistributedComponent::~DistributedComponent() = default;

void DistributedComponent::initialize(InitializePhase phase) {
  const bool is_first = phase == InitializePhase::advertise;
  impl_->enter(is_first ? Call::advertise : Call::realize);
  is_first ? impl_->advertise() : impl_->realize();
}

void DistributedComponent::initialize() {
  impl_->enter(Call::initialize);
  impl_->advertise(true);
  impl_->realize();
}

void DistributedComponent::set_import(const std::string& name, std::span<const double> owned) {
  Item& item = impl_->imports[find_item(impl_->imports, name, "import")];
  item.values.assign(owned.begin(), owned.end());
  item.is_given = true;
}

bool DistributedComponent::run(const Clock& clock) {
  impl_->enter(Call::run);
  const auto run_root = [&] {
    Component& root = *impl_->serial;
    root.run(root.import_state(), root.export_state(), clock);
  };
  impl_->need_parts(Call::run, run_root);
  impl_->check_run(clock);
  impl_->gather_imports(clock.current());
  impl_->on_root([&] {
    Grid before = impl_->serial->grid();
    run_root();
    impl_->former_grid = std::move(before);
  });
  // Only a run that succeeds takes the former grid away.
  impl_->former_parts.reset();
  impl_->transfer.reset();
  impl_->time = clock.next();
  return impl_->follow_root();
}

void DistributedComponent::write_restart(const std::string& path, const Clock& clock) const {
  impl_->enter(Call::write_restart);
  const auto write = [&] { impl_->serial->write_restart(path, clock); };
  impl_->need_parts(Call::write_restart, write);
  impl_->on_root(write);
}

void DistributedComponent::read_restart(const std::string& path, Clock& clock) {
  impl_->enter(Call::read_restart);
  std::vector<std::int64_t> state;
  std::optional<Clock> read;
  impl_->on_root([&] {
    read = clock;
    impl_->serial->read_restart(path, *read);
    state = read->state();
  });
  impl_->hand_out();
  std::array numbers{static_cast<std::int64_t>(state.size()),
                     std::int64_t{read && impl_->serial->current_time() ? 1 : 0}};
  impl_->team->broadcast(numbers, impl_->options.root);
  state.resize(static_cast<std::size_t>(numbers[0]));
  impl_->team->broadcast(state, impl_->options.root);
  impl_->team->together([&] { clock.restore(state); });
  impl_->time.reset();
  if (numbers[1] == 1) impl_->time = clock.current();
}

void DistributedComponent::finalize() {
  impl_->enter(Call::finalize);
  impl_->on_root([&] { impl_->serial->finalize(); });
  impl_->forget_former();
  impl_->parts.reset();
  impl_->generation = 0;
  impl_->time.reset();
  for (auto* items : {&impl_->imports, &impl_->exports}) {
    for (Item& item : *items) item = {item.info, {}, false};
  }
}

std::vector<double> DistributedComponent::transfer(std::span<const double> former,
                                                   const TransferOptions& options) const {
  impl_->enter(Call::transfer);
  impl_->need_former(Call::transfer);
  return impl_->carried(former, Location::cell, static_cast<int>(options.n_levels),
                        [&](const Transfer& by, std::span<const double> from,
                            std::span<double> to) { by.apply(from, to, options); });
}

std::vector<double> DistributedComponent::transfer_velocity(std::span<const double> former,
                                                            VelocityRoute route,
                                                            const TransferOptions& options) const {
  impl_->enter(Call::transfer_velocity);
  impl_->need_former(Call::transfer_velocity);
  return impl_->carried(former, Location::edge, static_cast<int>(options.n_levels),
                        [&](const Transfer& by, std::span<const double> from,
                            std::span<double> to) { by.apply_velocity(from, to, route, options); });
}

const std::vector<FieldInfo>& DistributedComponent::imports() const { return impl_->import_infos; }
const std::vector<FieldInfo>& DistributedComponent::exports() const { return impl_->export_infos; }

std::span<const double> DistributedComponent::get_export(const std::string& name) const {
  const Item& item = impl_->exports[find_item(impl_->exports, name, "export")];
  if (!impl_->parts) {
    refuse("export field " + name + " has no grid: initialize(realize) must come first");
  }
  return item.values;
}

const DistributedGrid& DistributedComponent::grid() const {
  if (!impl_->parts) {
    refuse("grid was called on a component without one; expected: initialize(realize)");
  }
  return *impl_->parts;
}

std::int64_t DistributedComponent::generation() const { return impl_->generation; }
const std::optional<Time>& DistributedComponent::current_time() const { return impl_->time; }
const std::string& DistributedComponent::remesh_decision() const { return impl_->decision; }
const std::string& DistributedComponent::remesh_failure() const { return impl_->failure; }

std::optional<State> DistributedComponent::whole_imports() const {
  if (!impl_->serial) return std::nullopt;
  return impl_->serial->import_state();
}

}  // namespace delos::mpi
