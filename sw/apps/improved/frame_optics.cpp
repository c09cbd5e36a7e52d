#include <apps/improved/frame_optics.h>
#include <marker/work.h>

#include <algorithm>
#include <tuple>

namespace improved {
namespace {

/// Once the curve is settled, one frame of so many is asked for it: the edges inside markers take
/// time (decision).
constexpr std::uint32_t settled_frames = 8;
constexpr std::uint32_t coefficients = sizeof hal_frame::distortion / sizeof(double);
static_assert(coefficients == std::tuple_size_v<decltype(marker::GeneralLens::coefficients)>);
static_assert(HAL_LENS_BROWN_CONRADY ==
              static_cast<std::uint32_t>(marker::LensModel::brown_conrady));
static_assert(HAL_LENS_RATIONAL == static_cast<std::uint32_t>(marker::LensModel::rational));
static_assert(HAL_LENS_EQUIDISTANT == static_cast<std::uint32_t>(marker::LensModel::equidistant));

}  // namespace

marker::Lens lens_of(const hal_frame& frame) {
  marker::Lens lens{{frame.fx, frame.fy, frame.cx, frame.cy}};
  if (frame.lens_model != HAL_LENS_BROWN_CONRADY) return lens;
  lens.k1 = frame.distortion[0];
  lens.k2 = frame.distortion[1];
  lens.p1 = frame.distortion[2];
  lens.p2 = frame.distortion[3];
  lens.k3 = frame.distortion[4];
  return lens;
}

void FrameOptics::open(const OpticsOptions& options) {
  options_ = options;
  if (options.response == ResponseChoice::srgb) marker::fill_srgb_light(given_);
  if (options.response == ResponseChoice::rec709) marker::fill_rec709_light(given_);
  if (options.response == ResponseChoice::exponent) marker::fill_light(options.exponent, given_);
  has_sought_ = false;
  frames_ = 0;
  const bool is_table = options.response == ResponseChoice::srgb ||
                        options.response == ResponseChoice::rec709 ||
                        options.response == ResponseChoice::exponent;
  if (is_table) marker::work(marker::Work::curves_made, 1);
}

/// HAL_RESPONSE_…
std::uint32_t FrameOptics::response_of(const hal_frame& frame) const {
  switch (options_.response) {
    case ResponseChoice::camera:
      return frame.response;
    case ResponseChoice::linear:
      return HAL_RESPONSE_LINEAR;
    case ResponseChoice::found:
      return HAL_RESPONSE_UNKNOWN;
    default:
      return HAL_RESPONSE_TABLE;
  }
}

Tries FrameOptics::tries_of(const hal_frame& frame) const {
  if (options_.tries != Tries::camera) return options_.tries;
  return frame.response == HAL_RESPONSE_LINEAR ? Tries::one : Tries::outlines;
}

const marker::Optics* FrameOptics::begin(const hal_frame& frame) {
  const std::uint32_t response = response_of(frame);
  const Tries tries = tries_of(frame);
  learns_ = false;
  use_ = {response != HAL_RESPONSE_LINEAR, marker::ResponseOrigin::given, 0};
  if (options_.response == ResponseChoice::exponent) use_.exponent = options_.exponent;
  optics_ = {};
  optics_.lens.camera = {frame.fx, frame.fy, frame.cx, frame.cy};
  optics_.lens.model = static_cast<marker::LensModel>(frame.lens_model);
  std::copy_n(frame.distortion, coefficients, optics_.lens.coefficients.begin());
  optics_.tries_again = tries != Tries::one;
  optics_.reads_outlines = tries == Tries::outlines;
  optics_.light = marker::linear_light();
  if (response == HAL_RESPONSE_TABLE) {
    optics_.light = options_.response == ResponseChoice::camera ? frame.light : given_.data();
    optics_.common_shift = marker::shift_left;
  }
  if (response == HAL_RESPONSE_UNKNOWN) {
    if (!has_sought_) finder_.open();
    has_sought_ = true;
    learns_ = !finder_.is_settled() || frames_ % settled_frames == 0;
    ++frames_;
    if (learns_) finder_.begin_frame();
    follow_finder();
  }
  const bool is_plain = frame.lens_model == HAL_LENS_BROWN_CONRADY && tries == Tries::one &&
                        response == HAL_RESPONSE_LINEAR;
  return is_plain ? nullptr : &optics_;
}

bool FrameOptics::learn(marker::Detections& found) {
  found.response = use_;
  if (!learns_) return false;
  for (std::uint32_t i = 0; i < found.count; ++i) finder_.add(found.markers[i].marker.inner);
  const bool look_again = finder_.end_look();
  if (look_again) {
    follow_finder();
    found.response = use_;
  }
  return look_again;
}

void FrameOptics::follow_finder() {
  optics_.seeks_response = learns_;
  optics_.light = finder_.light();
  optics_.common_shift = finder_.common_shift();
  const bool is_found = finder_.origin() == marker::ResponseOrigin::found;
  use_ = {true, finder_.origin(), is_found ? finder_.exponent() : 0};
}

}  // namespace improved
