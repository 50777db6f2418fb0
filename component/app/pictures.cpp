// SPDX-License-Identifier: BSD-3-Clause
#include "app/pictures.hpp"

#include "core/error.hpp"
#ifdef DELOS_HAS_PICTURES
#include "pictures/globe.hpp"
#include "pictures/histograms.hpp"
#include "pictures/map.hpp"
#endif

namespace delos::app {

#ifdef DELOS_HAS_PICTURES
void draw_picture(const PictureSubject& subject, const std::string& picture,
                  const std::string& path) {
  pictures::PictureOptions options;
  options.title = subject.title;
  if (subject.wishes != nullptr) {
    options.view_lon_deg = subject.wishes->view.lon_rad * kDegPerRad;
    options.view_lat_deg = subject.wishes->view.lat_rad * kDegPerRad;
    options.has_view = subject.wishes->has_view;
    options.view_radius_deg = subject.wishes->view_radius_deg;
  }
  options.land = subject.elevation_m;
  if (picture == "globe") {
    pictures::draw_globe(subject.grid, options, path);
  } else if (picture == "map") {
    pictures::draw_map(subject.grid, options, path);
  } else {
    DELOS_ASSERT(picture == "histograms");
    pictures::draw_histograms(subject.quality, options, path);
  }
}
#else
void draw_picture(const PictureSubject&, const std::string& picture, const std::string&) {
  throw Error(ErrorKind::output, text("this build of delos draws no pictures (", picture,
                                      "). Build it with cairo, or leave output.pictures out."));
}
#endif

}  // namespace delos::app
