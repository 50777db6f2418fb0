// SPDX-License-Identifier: BSD-3-Clause
#include "lifecycle/component.hpp"

#include <array>
#include <utility>
#include <vector>

#include "core/error.hpp"
#include "core/types.hpp"
#include "lifecycle/restart.hpp"
#include "time/iso8601.hpp"

namespace delos {
namespace {

constexpr double kTurn_deg = 360.0;

/// What the engine can use; held for its host in this version.
std::vector<FieldTraits> import_traits() {
  return {{.name = "surface_eastward_sea_water_velocity",
           .standard_name = "surface_eastward_sea_water_velocity",
           .units = "m s-1",
           .long_name = "eastward velocity of the surface water"},
          {.name = "surface_northward_sea_water_velocity",
           .standard_name = "surface_northward_sea_water_velocity",
           .units = "m s-1",
           .long_name = "northward velocity of the surface water"},
          {.name = "eddy_kinetic_energy",
           .standard_name = "eddy_kinetic_energy",
           .units = "m2 s-2",
           .long_name = "kinetic energy of the surface eddies, a mass unit's"}};
}

// The exports, in the order of their declaration.
enum Export : std::size_t { area, spacing, longitude, latitude, generation_number, n_exports };

std::vector<FieldTraits> export_traits() {
  return {{.name = "cell_area",
           .standard_name = "cell_area",
           .units = "m2",
           .long_name = "area of the Voronoi cell"},
          {.name = "cell_spacing",
           .standard_name = "",
           .units = "m",
           .long_name = "distance to the neighbours that was asked for"},
          {.name = "cell_longitude",
           .standard_name = "longitude",
           .units = "degrees_east",
           .long_name = "longitude of the cell's generator"},
          {.name = "cell_latitude",
           .standard_name = "latitude",
           .units = "degrees_north",
           .long_name = "latitude of the cell's generator, of the configured kind"},
          {.name = "grid_generation",
           .standard_name = "",
           .units = "1",
           .long_name = "number of the grid, which grows whenever it is made anew",
           .location = Location::grid}};
}

/// What a component with a section `remesh` tells beside these.
std::vector<FieldTraits> remesh_export_traits() {
  return {{.name = "remesh_mismatch",
           .standard_name = "",
           .units = "1",
           .long_name = "share of the area whose spacing was off at the last alarm",
           .location = Location::grid},
          {.name = "remesh_decision",
           .standard_name = "",
           .units = "1",
           .long_name = "at the last alarm: 1 remeshed, 0 not, -1 failed",
           .location = Location::grid}};
}

/// The only alarm of a component's clock.
constexpr int kRemeshAlarm = 0;

void declare_all(State& state, const std::vector<FieldTraits>& fields) {
  for (const FieldTraits& traits : fields) state.declare(traits);
}

/// A grid with what only the exports need; they keep it together.
struct Exported {
  std::shared_ptr<const Product> product;
  std::vector<double> lon_deg, lat_deg;
  double generation = 0.0;
};

std::shared_ptr<const Exported> exported(std::shared_ptr<const Product> product,
                                         std::int64_t generation) {
  auto out = std::make_shared<Exported>();
  const Array<LonLat>& places = product->grid->cell_lon_lat;
  out->lon_deg.reserve(places.size());
  out->lat_deg.reserve(places.size());
  for (const LonLat& place : places) {
    const double lon_deg = place.lon_rad * kDegPerRad;
    // The product may round up to the whole turn.
    out->lon_deg.push_back(lon_deg < kTurn_deg ? lon_deg : 0.0);
    out->lat_deg.push_back(place.lat_rad * kDegPerRad);
  }
  out->generation = static_cast<double>(generation);
  out->product = std::move(product);
  return out;
}

void attach_exports(const State& exports, const std::shared_ptr<const Exported>& values,
                    std::int64_t generation) noexcept {
  const Grid& grid = *values->product->grid;
  std::array<std::span<const double>, n_exports> spans;
  spans[area] = grid.cell_area_m2;
  spans[spacing] = grid.cell_spacing_m;
  spans[longitude] = values->lon_deg;
  spans[latitude] = values->lat_deg;
  spans[generation_number] = {&values->generation, 1};
  for (std::size_t i = 0; i < spans.size(); ++i) {
    exports.items()[i]->attach(
        {generation, static_cast<std::int64_t>(spans[i].size()), spans[i], values});
  }
}

/// Values of remesh_export_traits().
using Told = decltype(Remesh::told);

/// The remesh's exports stand behind the others.
void attach_told(const State& exports, const std::shared_ptr<const Told>& told,
                 std::int64_t generation) noexcept {
  for (std::size_t i = n_exports; i < exports.items().size(); ++i) {
    const std::span<const double> value = std::span(*told).subspan(i - n_exports, 1);
    exports.items()[i]->attach({generation, 1, value, told});
  }
}

std::int64_t n_points(const Grid& grid, Location location) {
  return location == Location::edge ? grid.n_edges() : grid.n_cells();
}

/// The call that leads on from a stage.
const char* expected_call(Stage stage) {
  switch (stage) {
    case Stage::created:
    case Stage::finalized:
      return "initialize(advertise)";
    case Stage::advertised:
      return "initialize(realize) or read_restart";
    case Stage::realized:
    case Stage::running:
      return "run or finalize";
  }
  return "none";
}

}  // namespace

const char* to_string(Stage stage) {
  switch (stage) {
    case Stage::created:
      return "created";
    case Stage::advertised:
      return "advertised";
    case Stage::realized:
      return "realized";
    case Stage::running:
      return "running";
    case Stage::finalized:
      return "finalized";
  }
  return "unknown";
}

Component::Component(Settings settings, ComponentOptions options)
    : settings_(std::move(settings)),
      options_(std::move(options)),
      imports_(std::make_shared<State>(Intent::imports)),
      exports_(std::make_shared<State>(Intent::exports)) {}

Component::~Component() { release_fields(); }

void Component::refuse(const char* call) const {
  throw Error(ErrorKind::state, text(call, " was called on a component that is ", to_string(stage_),
                                     "; expected: ", expected_call(stage_)));
}

void Component::advertise() {
  if (stage_ == Stage::advertised) return;
  if (stage_ != Stage::created && stage_ != Stage::finalized) refuse("initialize(advertise)");
  if (stage_ == Stage::created) {
    State imports(Intent::imports);
    State exports(Intent::exports);
    declare_all(imports, import_traits());
    declare_all(exports, export_traits());
    if (settings_.remesh) {
      declare_all(imports, Solution::imports(*settings_.remesh));
      declare_all(exports, remesh_export_traits());
    }
    *imports_ = std::move(imports);
    *exports_ = std::move(exports);
  }
  stage_ = Stage::advertised;
}

void Component::realize() {
  if (stage_ == Stage::realized) return;
  if (stage_ != Stage::advertised) refuse("initialize(realize)");
  parallel::Executor exec(options_.threads > 0 ? options_.threads : settings_.threads);
  Monitor monitor(options_.on_progress, options_.on_log, options_.cancel);
  Context context{exec, monitor};
  Inputs inputs = read_inputs(context, settings_);
  Sized sized = size(context, settings_, inputs.recipe);
  auto product =
      std::make_shared<const Product>(generate(context, settings_, inputs, std::move(sized), {}));
  start_remeshing();
  if (remesh_) remesh_->keep(std::move(inputs), settings_);
  put_in_place(std::move(product), last_generation_ + 1);
  stage_ = Stage::realized;
}

void Component::put_in_place(std::shared_ptr<const Product> product, std::int64_t number) {
  const auto values = exported(product, number);
  const auto told = std::make_shared<const Told>(remesh_ ? remesh_->told : Told{});

  // Nothing throws from here on.
  for (const auto& item : imports_->items()) {
    item->attach({number, n_points(*product->grid, item->traits().location), {}, nullptr});
  }
  attach_exports(*exports_, values, number);
  attach_told(*exports_, told, number);
  product_ = std::move(product);
  last_generation_ = number;
}

void Component::write_restart(const std::string& path, const Clock& host) const {
  if (stage_ != Stage::realized && stage_ != Stage::running) refuse("write_restart");
  if (clock_) {
    const Time &mine = clock_->current(), &hosts = host.current();
    DELOS_CHECK(mine.calendar() == hosts.calendar() && mine == hosts, ErrorKind::state,
                "write_restart was called with a clock at ", iso_text(hosts), " (",
                to_string(hosts.calendar()), "), but the last run ended at ", iso_text(mine), " (",
                to_string(mine.calendar()), "): advance the clock before");
  }
  delos::write_restart(path, {product_, last_generation_, host, clock_, std::nullopt},
                       remesh_ ? &*remesh_ : nullptr);
}

Clock Component::read_restart(const std::string& path, const Clock& host) {
  if (stage_ != Stage::advertised) refuse("read_restart");
  parallel::Executor exec(options_.threads > 0 ? options_.threads : settings_.threads);
  Monitor monitor(options_.on_progress, options_.on_log, options_.cancel);
  Context context{exec, monitor};
  Restart state = delos::read_restart(context, settings_, path);
  const Calendar theirs = state.host.start().calendar(), mine = host.start().calendar();
  DELOS_CHECK(theirs == mine, ErrorKind::config, "the restart file ", path, " counts in ",
              to_string(theirs), ", the clock given in ", to_string(mine),
              ": give a clock of that calendar.");
  start_remeshing();
  remesh_ = std::move(state.remesh);
  put_in_place(std::move(state.product), state.generation);
  stage_ = Stage::realized;
  if (state.component) {
    for (const auto& item : exports_->items()) item->stamp(state.component->current());
    stage_ = Stage::running;
  }
  clock_ = std::move(state.component);
  return std::move(state.host);
}

void Component::run(const Time& from, const Time& until) {
  if (stage_ != Stage::realized && stage_ != Stage::running) refuse("run");
  DELOS_CHECK(until > from, ErrorKind::state, "run from ", iso_text(from), " until ",
              iso_text(until), ": the end must be later");
  std::optional<Clock> clock = clock_;
  if (!clock) {
    clock = Clock({.start = from, .step = until - from});
    if (settings_.remesh) clock->add_alarm({.interval = settings_.remesh->interval});
  }
  DELOS_CHECK(clock->current().calendar() == from.calendar() && clock->current() == from,
              ErrorKind::state, "run from ", iso_text(from), " (", to_string(from.calendar()),
              "), but the component stands at ", iso_text(clock->current()), " (",
              to_string(clock->current().calendar()), "): run every step once, in order");
  clock->advance(until - from);
  if (remesh_) follow_imports(*clock, (until - from).seconds().to_double());

  clock_ = std::move(clock);
  for (const auto& item : exports_->items()) item->stamp(until);
  stage_ = Stage::running;
}

void Component::start_remeshing() {
  decision_.reset();
  remesh_failure_.clear();
  remesh_.reset();
  if (settings_.remesh) remesh_.emplace(*settings_.remesh);
}

void Component::follow_imports(Clock& clock, double duration_s) {
  parallel::Executor exec(options_.threads > 0 ? options_.threads : settings_.threads);
  remesh_->solution.add(exec, *imports_, *product_->grid, duration_s);
  Alarm& alarm = clock.alarm(kRemeshAlarm);
  if (!alarm.is_ringing()) return;
  alarm.ringer_off();
  Monitor monitor(options_.on_progress, options_.on_log, options_.cancel);
  Context context{exec, monitor};
  take(try_remesh(context, *product_, clock.current(), *remesh_), clock.current());
}

void Component::take(RemeshOutcome outcome, const Time& now) {
  if (outcome.product) {
    put_in_place(std::move(outcome.product), last_generation_ + 1);
    remesh_->solution = std::move(*outcome.solution);
    note_remesh(now, remesh_->policy);
    // Only a grid that could not follow has to wait.
    remesh_->policy.is_armed = outcome.has_followed;
  }
  const bool has_failed = !outcome.failure.empty();
  const double decided = has_failed ? -1.0 : outcome.decision.remesh ? 1.0 : 0.0;
  remesh_->told = {outcome.decision.mismatch.total(), decided};
  attach_told(*exports_, std::make_shared<const Told>(remesh_->told), last_generation_);
  decision_ = std::move(outcome.decision);
  remesh_failure_ = std::move(outcome.failure);
}

void Component::finalize() {
  if (stage_ == Stage::finalized) return;
  if (stage_ == Stage::created) refuse("finalize");
  release_fields();
  product_.reset();
  clock_.reset();
  remesh_.reset();
  stage_ = Stage::finalized;
}

std::int64_t Component::generation() const { return product_ ? last_generation_ : 0; }

std::shared_ptr<const Product> Component::product() const {
  if (!product_) refuse("grid");
  return product_;
}

void Component::release_fields() noexcept {
  for (const auto& state : {imports_, exports_}) {
    for (const auto& item : state->items()) item->release();
  }
}

}  // namespace delos
