#pragma once

#include <pl/common/geometry.h>

#include <string>
#include <vector>

#include "frames.h"

/// A picture and its size.
struct Picture {
  std::string name;
  pl::Geometry geometry;
  harness::Image image;
};

/// `share` of 1000 pixels dark (20), the others bright (200).
harness::Image dots(const pl::Geometry& geometry, std::uint32_t share, std::uint64_t seed);

/// Every other pixel dark, in both directions.
harness::Image checkerboard(const pl::Geometry& geometry);

/// Everything that is to be the same, at one size: noise, dots of several densities, rectangles,
/// stripes, a checkerboard, one level only, extreme levels only.
std::vector<Picture> patterns(const pl::Geometry& geometry);

/// Scenes of chapter 5.
std::vector<Picture> scenes();

/// Sizes at the limits of what can be built, and with rows that are no multiple of 64 px.
std::vector<pl::Geometry> small_sizes();
