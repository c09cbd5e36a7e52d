#include "synthetic.h"

#include <cstdlib>
#include <stdexcept>

#include <marker/scene/scene.h>
#include <marker/validation/validation.h>

namespace synthetic {

using namespace platform::validation;

namespace {

FoundTrue found(double width_px) {
  FoundTrue truth;
  truth.width_px = width_px;
  truth.corner_px = 1.5;
  truth.translation_mm = 30;
  truth.rotation_deg = 4;
  truth.iterations = 2;
  return truth;
}

Frame image(const std::string& group, const std::string& input) {
  Frame frame;
  frame.input = input;
  frame.group = group;
  frame.threshold = 127;
  frame.corners = 12;
  frame.blobs = 2;
  frame.candidates = 1;
  frame.markers = "[" + input + "]";
  frame.found = found(100);
  return frame;
}

std::string group_of(const std::string& input) {
  return input.substr(0, input.find_first_of("-0123456789"));
}

double sum(const Frame& frame, const std::vector<std::string>& stages) {
  double us = 0;
  for (const std::string& stage : stages) us += frame.times_us.at(stage);
  return us;
}

}  // namespace

Frame hybrid_frame(const std::string& input, double identification_ms) {
  Frame frame = image(group_of(input), input);
  frame.times_us = {{"upload", 4800},  {"feature_extraction", 6000},
                    {"receive", 1000}, {"evaluation", 500},
                    {"pose", 500},     {"identification", identification_ms * 1000}};
  frame.times_us["frame"] =
      sum(frame, {"feature_extraction", "receive", "evaluation", "identification", "pose"});
  return frame;
}

Frame ps_frame(const std::string& input, double corner_ms, double blob_ms,
               double identification_ms) {
  Frame frame = image(group_of(input), input);
  frame.times_us = {{"capture", 6000},
                    {"corner_detection", corner_ms * 1000},
                    {"threshold", 10000},
                    {"blob_detection", blob_ms * 1000},
                    {"receive", 0},
                    {"evaluation", 500},
                    {"identification", identification_ms * 1000},
                    {"pose", 500}};
  frame.times_us["feature_extraction"] =
      sum(frame, {"capture", "corner_detection", "threshold", "blob_detection"});
  frame.times_us["frame"] =
      sum(frame, {"feature_extraction", "evaluation", "identification", "pose"});
  return frame;
}

Measured all_images() {
  Measured measured;
  measured.hybrid.system = "hybrid";
  measured.ps_only.system = "ps-only";
  for (Run* run : {&measured.hybrid, &measured.ps_only}) {
    run->profile = "thesis";
    run->fidelity = "tlm";
  }
  for (const platform::SceneGroup& group : platform::scene_groups()) {
    if (group.name == "demo") continue;
    for (const std::string& input : group.scenes) {
      Frame place;
      place.input = input;
      place.group = group.name;
      // "squares7" has seven.
      const double more =
          group.name == "squares" ? std::atof(input.c_str() + group.name.size()) - 1 : 0;
      measured.hybrid.frames.push_back(hybrid_frame(input, 2 + more));
      measured.ps_only.frames.push_back(ps_frame(input, 40 + more, 20 + 2 * more, 1 + more / 2));
    }
  }
  return measured;
}

std::vector<Published> published() {
  return read_published(std::string(MARKERVP_DATA) + "/published.csv");
}

Row row(const std::vector<Row>& rows, const std::string& id) {
  for (const Row& one : rows) {
    if (one.published.id == id) return one;
  }
  throw std::out_of_range(id);
}

}  // namespace synthetic
