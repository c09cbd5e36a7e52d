// What the detector of the design `improved` does in light, and through lenses of any model.
#include "driver.h"

#include <marker/camera.h>
#include <marker/code_book.h>
#include <marker/inner_edges.h>
#include <marker/light_curves.h>
#include <marker/local_blobs.h>
#include <marker/optics.h>
#include <marker/optics_fit.h>
#include <marker/outline.h>

#include <cstddef>
#include <vector>

namespace calibration {
namespace {

marker::Optics random_optics(Random& random, const marker::LightTable& light) {
  marker::Optics optics{};
  optics.lens.camera = {381.36, 381.36, 100, 70};
  optics.light = light.data();
  optics.lens.model = static_cast<marker::LensModel>(random.below(marker::lens_model_count));
  if (random.below(3) == 0 && optics.lens.model != marker::LensModel::equidistant) return optics;
  for (double& k : optics.lens.coefficients) k = 0.02 * (random.unit() - 0.5);
  return optics;
}

/// A square of the scene as a quadrilateral that was found.
marker::QuadFit found(const marker::CameraFrame& frame, const marker::Quad& square,
                      Random& random) {
  marker::Quad corners{square[0], square[1], square[3], square[2]};
  for (marker::Point& p : corners) {
    p.x += 0.4 * (random.unit() - 0.5);
    p.y += 0.4 * (random.unit() - 0.5);
  }
  marker::QuadFit fit = marker::guess_through_optics(frame, corners, {});
  fit.reach = 0.8;
  fit.dark = 40;
  fit.bright = 200;
  return fit;
}

/// A pixel of a square: of its middle, so that the way out is part of the work.
marker::Pixel inside(const marker::Quad& square) {
  marker::Point sum{0, 0};
  for (const marker::Point& p : square) sum = sum + p;
  return {static_cast<std::int32_t>(sum.x / 4), static_cast<std::int32_t>(sum.y / 4)};
}

void add(Checksum& sum, const marker::QuadFit& fit) {
  sum.add(fit.refusal);
  sum.add(fit.ideal);
  sum.add(fit.covariance);
}

}  // namespace

void measure_optics(Random& random, std::uint32_t width, std::uint32_t height) {
  static marker::LightTable light;
  const double exponent = 1 + 2 * random.unit();
  measure(
      "response",
      [&] {
        marker::fill_light(exponent, light);
        marker::work(marker::Work::curves_made, 1);
      },
      [&] {
        Checksum sum;
        sum.add(light);
        return sum;
      });
  const Scene scenes[] = {{random, width, height}, {random, width, height}};
  struct Candidate {
    marker::CameraFrame frame;
    marker::Pixel inside;
    marker::QuadFit fit;
    marker::LightLevels levels;
    marker::InnerShift inner;
    marker::OutlineQuads outline;
  };
  const marker::Optics optics = random_optics(random, light);
  std::vector<Candidate> candidates;
  for (const Scene& scene : scenes) {
    for (const marker::Quad& square : scene.squares()) {
      marker::CameraFrame frame{scene.image(), {optics.lens.camera}};
      frame.optics = &optics;
      candidates.push_back({frame, inside(square), found(frame, square, random), {}, {}, {}});
    }
  }
  measure(
      "lit_fit",
      [&] {
        // One of three is measured again.
        for (std::size_t i = 0; i < candidates.size(); ++i) {
          Candidate& c = candidates[i];
          const marker::FoundIn place =
              i % 3 == 2 ? marker::FoundIn::light : marker::FoundIn::levels;
          c.levels = marker::refine_through_optics(c.frame, once(), place, c.fit);
        }
      },
      [&] {
        Checksum sum;
        for (const Candidate& c : candidates) add(sum, c.fit);
        return sum;
      });
  // What was refused has levels, too, so that every picture has edges. The lens has costs of its
  // own.
  marker::Optics pinhole = optics;
  pinhole.lens = {optics.lens.camera};
  double reach = 0.8;  // sharp and blurred
  for (Candidate& c : candidates) {
    c.frame.optics = &pinhole;
    c.fit.reach = reach;
    reach = reach < 2.4 ? reach + 0.3 : 0.8;
    c.levels = {4000, 50000};
  }
  const marker::Dictionary& dictionary = *marker::find_dictionary("4x4_250");
  const std::uint64_t word = dictionary.words[random.below(dictionary.size)];
  measure(
      "inner_edges",
      [&] {
        for (Candidate& c : candidates) {
          c.inner = marker::measure_inner_edges(c.frame, c.fit, c.levels, word, dictionary.cells);
        }
      },
      [&] {
        Checksum sum;
        for (const Candidate& c : candidates) {
          sum.add(c.inner.shift);
          sum.add(c.inner.edges);
        }
        return sum;
      });
  measure(
      "outline",
      [&] {
        for (Candidate& c : candidates) c.outline = marker::quads_of_outline(c.frame, c.inside);
      },
      [&] {
        Checksum sum;
        for (const Candidate& c : candidates) sum.add(c.outline);
        return sum;
      });
  static marker::LocalBlobs local;
  marker::BlobList blobs{};
  measure(
      "local_blobs", [&] { blobs = local.find(scenes[0].image(), 9); },
      [&] {
        Checksum sum;
        sum.add(blobs.count);
        return sum;
      });
}

}  // namespace calibration
