#include "targets.h"

#include <chip/block_design/design_file.h>
#include <chip/fault/fault.h>
#include <chip/handoff/handoff.h>
#include <chip/run/cost_profile.h>
#include <cli/faults/campaign_file.h>
#include <fpga/power/design_figures.h>
#include <fpga/power/power_table.h>
#include <marker/input/camera_file.h>
#include <marker/input/image_file.h>
#include <study/compare.h>
#include <study/spec.h>
#include <trace/tools.h>
#include <vp/configuration.h>
#include <vp/error.h>
#include <vp/expression.h>
#include <vp/file.h>
#include <vp/wave_reader.h>

#include <unistd.h>
#include <cstdio>
#include <fstream>

namespace fuzz {

namespace {

/// Takes all that a trace has.
struct Drain : vp::WaveHandler {
  bool at(std::uint64_t) override { return true; }
  void change(std::uint32_t, const vp::WaveValue&) override {}
};

void read_wave(const std::string& path) {
  vp::WaveReader reader(path);
  reader.select_all();
  Drain drain;
  reader.read(drain);
  reader.warnings();
}

std::string text_of(const std::string& path) {
  return vp::read_text(path, "seed");
}

}  // namespace

const std::vector<Target>& targets() {
  static const std::vector<Target> list = {
      {"image", ".png", [](const std::string& path) { platform::input::read_image(path); }},
      {"camera", ".yaml", [](const std::string& path) { platform::input::read_camera_file(path); }},
      {"configuration", ".yaml",
       [](const std::string& path) {
         vp::Configuration configuration;
         configuration.load_file(path);
       }},
      {"expression", ".txt",
       [](const std::string& path) { vp::Expression(text_of(path), "seed"); }},
      {"study", ".yaml", [](const std::string& path) { platform::study::read_spec(path); }},
      {"result", ".json", [](const std::string& path) { platform::study::read_comparable(path); }},
      {"wave", ".vcd", read_wave},
      {"checks", ".yaml", [](const std::string& path) { platform::trace::read_checks(path); }},
      {"costs", ".json",
       [](const std::string& path) { platform::profiles::load_cost_profile(path, {}); }},
      {"handoff", ".hwh", [](const std::string& path) { platform::handoff::read_handoff(path); }},
      {"design", ".yaml",
       [](const std::string& path) { platform::block_design::read_design_file(path); }},
      {"faults", ".yaml",
       [](const std::string& path) { platform::parse_faults(text_of(path), path); }},
      {"campaign", ".yaml", [](const std::string& path) { platform::cli::read_campaign(path); }},
  };
  return list;
}

bool feed(const Target& target, const std::string& bytes) {
  const std::string path =
      "/dev/shm/markervp_fuzz_" + std::to_string(::getpid()) + "_" + target.name + target.extension;
  {
    std::ofstream file(path, std::ios::binary);
    file << bytes;
  }
  bool accepted = true;
  try {
    target.read(path);
  } catch (const vp::InputError&) {
    accepted = false;
  }
  std::remove(path.c_str());
  return accepted;
}

}  // namespace fuzz
