// SPDX-License-Identifier: BSD-3-Clause
#include "pictures/canvas.hpp"

#include <doctest/doctest.h>

#include <cmath>

#include "core/error.hpp"

using namespace delos;
using namespace delos::pictures;

namespace {

bool same(const Colour& a, const Colour& b) {
  constexpr double kRounding = 1.01 / 255.0;
  return std::abs(a.r - b.r) < kRounding && std::abs(a.g - b.g) < kRounding &&
         std::abs(a.b - b.b) < kRounding && std::abs(a.a - b.a) < kRounding;
}

}  // namespace

TEST_CASE("a canvas holds the background, boxes and images where they were put") {
  const Colour white{1, 1, 1, 1}, red{0.8, 0.1, 0.2, 1}, blue{0.1, 0.2, 0.9, 1};
  Canvas canvas(40, 30, white);
  canvas.fill_box({10, 5, 10, 10}, red);
  canvas.image({4, 2, std::vector<Colour>(8, blue)}, {30, 20});
  CHECK(canvas.width() == 40);
  CHECK(canvas.height() == 30);
  CHECK(same(canvas.pixel(0, 0), white));
  CHECK(same(canvas.pixel(15, 10), red));
  CHECK(same(canvas.pixel(9, 10), white));
  CHECK(same(canvas.pixel(20, 10), white));
  CHECK(same(canvas.pixel(33, 21), blue));
  CHECK(same(canvas.pixel(33, 22), white));
}

TEST_CASE("nothing is drawn outside a clip, and everything again after unclip") {
  const Colour white{1, 1, 1, 1}, black{0, 0, 0, 1};
  Canvas canvas(40, 40, white);
  canvas.clip_box({0, 0, 20, 40});
  canvas.fill_box({0, 0, 40, 20}, black);
  canvas.unclip();
  CHECK(same(canvas.pixel(10, 10), black));
  CHECK(same(canvas.pixel(30, 10), white));
  canvas.fill_box({0, 0, 40, 20}, black);
  CHECK(same(canvas.pixel(30, 10), black));
}

TEST_CASE("text leaves ink, upright text too") {
  const Colour white{1, 1, 1, 1};
  for (const bool upright : {false, true}) {
    Canvas canvas(60, 60, white);
    canvas.text({30, 30}, "HHH", {.size = 16, .anchor_x = 0.5, .upright = upright});
    int n_inked = 0;
    for (int row = 0; row < 60; ++row) {
      for (int column = 0; column < 60; ++column)
        n_inked += !same(canvas.pixel(column, row), white);
    }
    CHECK(n_inked > 40);
    CHECK(n_inked < 1200);
  }
}

TEST_CASE("a picture that can't be written is an output error that names the path") {
  Canvas canvas(4, 4, {1, 1, 1, 1});
  try {
    canvas.write_png("/nonexistent/folder/picture.png");
    FAIL("no error");
  } catch (const Error& error) {
    CHECK(error.kind() == ErrorKind::output);
    CHECK(std::string(error.what()).find("/nonexistent/folder/picture.png") != std::string::npos);
  }
}

TEST_CASE("a canvas beyond what cairo can make is a resource error") {
  CHECK_THROWS_AS(Canvas(100000, 100000, {1, 1, 1, 1}), Error);
}
