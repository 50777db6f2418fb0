// SPDX-License-Identifier: BSD-3-Clause
#include "lifecycle/mesh_order.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <tuple>

#include "dual/validate.hpp"
#include "partition/kway.hpp"
#include "support/expect_error.hpp"
#include "support/products.hpp"

using namespace delos;
using delos::testing::expect_error;
using delos::testing::made;
using delos::testing::value_of;

namespace {

const std::string kFrontal = "sizing: {sources: [{type: constant, spacing: 900 km}]}\n";
const std::string kIcosahedral = "generator: icosahedral\nsubdivisions: 12\n";

std::vector<std::tuple<double, double, double, double>> sorted_vertices(const Product& product) {
  std::vector<std::tuple<double, double, double, double>> out;
  for (const Vertex& vertex : product.mesh.vertices) {
    out.emplace_back(vertex.x, vertex.y, vertex.z, vertex.spacing);
  }
  std::sort(out.begin(), out.end());
  return out;
}

void expect_sound(const Product& product) {
  const auto defects = validate(product.mesh, product.settings.surface, {});
  CHECK_MESSAGE(defects.empty(), summary(defects));
  parallel::Executor exec(2);
  Monitor monitor;
  Context context{exec, monitor};
  for (const BrokenRule& rule : check_grid(context, *product.grid)) FAIL_CHECK(to_string(rule));
}

}  // namespace

TEST_CASE("another order moves no cell and keeps neighbours near, for any number of threads") {
  for (const std::string& head : {kFrontal, kIcosahedral}) {
    const Product kept = made(head, 2);
    for (const std::string order : {"hilbert", "metis, order_parts: 8"}) {
      if (order[0] == 'm' && !kway::is_available()) continue;
      CAPTURE(head + order);
      const std::string yaml = head + "output: {order: " + order + "}\n";
      const Product product = made(yaml, 1);
      CHECK(sorted_vertices(product) == sorted_vertices(kept));
      CHECK(product.report.digest != kept.report.digest);
      expect_sound(product);
      CHECK(value_of<double>(product.report, "order", "mean_id_difference") <
            0.06 * static_cast<double>(product.mesh.n_vertices()));
      CHECK(std::is_sorted(product.mesh.triangles.begin(), product.mesh.triangles.end(),
                           [](const Triangle& a, const Triangle& b) {
                             return std::ranges::min(a.vertex) < std::ranges::min(b.vertex);
                           }));
      const Product again = made(yaml, 5);
      CHECK(again.report.digest == product.report.digest);
    }
  }
}

TEST_CASE("METIS's parts stand one after the other, cells along the curve within each") {
  if (!kway::is_available()) return;
  const Product product = made(kIcosahedral + "output: {order: metis, order_parts: 4}\n", 2);
  // Every part hangs together: a cell has a neighbour in its own quarter (sizes differ by 3 %).
  const Grid& grid = *product.grid;
  const auto quarter = [&](Index cell) { return 4.0 * cell / grid.n_cells(); };
  std::int64_t n_far = 0;
  for (const auto& [a, b] : grid.cells_on_edge) n_far += quarter(b) - quarter(a) > 1.2;
  CHECK(static_cast<double>(n_far) < 0.1 * static_cast<double>(grid.n_edges()));
}

TEST_CASE("orders that can't be had are refused with their key") {
  const auto refused = [](const std::string& yaml, std::initializer_list<std::string> parts) {
    expect_error(ErrorKind::config, parts, [&] { made(kFrontal + yaml, 1); });
  };
  refused("output: {order: hilbrt}\n", {"output.order", "Did you mean 'hilbert'"});
  refused("output: {ordr: metis}\n", {"ordr", "Did you mean 'order'"});
  refused("output: {order: metis}\n", {"output.order_parts", "order_parts: 64"});
  refused("output: {order_parts: 8}\n", {"output.order_parts", "order: metis"});
  refused("data_path: []\ndomain: {}\noutput: {order: hilbert}\n", {"output", "domain.order"});
  refused("region: {disc: {centre: [0 deg, 0 deg], radius: 2000 km}}\noutput: {order: hilbert}\n",
          {"output", "region"});
  refused(
      "constraints: {shapes: [{type: points, points: [0 deg, 0 deg]}]}\n"
      "output: {order: hilbert}\n",
      {"output", "constraints"});
}
