#include <apps/common/search.h>

#include <drivers/timers.h>
#include <hal/hal.h>
#include <marker/identification.h>
#include <marker/marker_search.h>
#include <marker/work.h>

namespace apps {

namespace {

enum class Option : std::uint32_t {
#define SEARCH_ENUMERATOR(name, ...) name,
  SEARCH_OPTIONS(SEARCH_ENUMERATOR)
#undef SEARCH_ENUMERATOR
};

double value(Option option) {
  return hal_option(static_cast<std::uint32_t>(option));
}

}  // namespace

SearchOptions read_search_options() {
  SearchOptions options{};
  options.margin = value(Option::margin);
  options.canonical_width = marker::canonical_width(value(Option::canonical_width));
  options.marker_side = value(Option::marker_side);
  options.reprojection_stop = value(Option::reprojection_stop);
  options.iteration_limit = static_cast<std::uint32_t>(value(Option::iteration_limit));
  return options;
}

void begin(const hal_frame& frame, marker::FrameResult& result) {
  marker::work(marker::Work::frames, 1);
  marker::clear(result);
  result.frame = frame.index;
  result.width = frame.width;
  result.height = frame.height;
}

void find_marker(const hal_frame& frame, const marker::BinaryImage& image,
                 const SearchOptions& options, std::uint64_t start, marker::FrameResult& result) {
  const drivers::GlobalTimer timer{};
  marker::StageTimes& times = result.times;
  times.evaluation.start = start;
  marker::evaluate_features(result.features, {options.margin}, result.candidates);
  times.evaluation.end = times.identification.start = timer.now();

  const marker::FoundMarker found =
      marker::find_first_marker(result.features, result.candidates, image, options.canonical_width);
  result.examined = found.examined;
  times.identification.end = times.pose.start = timer.now();

  if (found.found) {
    marker::Marker& marker = result.markers[result.marker_count++];
    marker.candidate = found.candidate;
    marker.identity = found.identity;
    marker.corners = found.corners;
    marker.pose = marker::estimate_pose(
        found.corners, {frame.fx, frame.fy, frame.cx, frame.cy},
        {options.marker_side, options.reprojection_stop, options.iteration_limit});
  }
  times.pose.end = times.frame.end = timer.now();
}

}  // namespace apps
