#include <marker/designs/marker/marker_ip.h>

#include <chip/block_design/place_ports.h>
#include <marker/designs/marker/marker_work.h>

#include <algorithm>
#include <memory>
#include <string>
#include <utility>

namespace platform {

namespace {

using block_design::End;
using block_design::Placed;
using block_design::PlacedPart;
using block_design::Placement;
using block_design::Surroundings;

block_design::ParameterRule build_option(const char* name, const char* usual, const char* sets) {
  block_design::ParameterRule rule{name, usual};
  rule.sets = sets;
  return rule;
}

vp::Clock& clock_of(const Placement& at, const char* pin) {
  return at.clock({pin});
}

Placed place(const Placement& at) {
  auto logic =
      std::make_unique<pl::FeatureExtraction>(at.part.name.c_str(), clock_of(at, "system_clk"),
                                              clock_of(at, "pixel_clk"), at.ports.fidelity);
  Placed placed;
  pl::FeatureExtraction* models = logic.get();
  vp::Clock& system_clk = clock_of(at, "system_clk");
  placed.inputs = {{"gpio_in", block_design::input(at, "gpio_in", logic->gpio_in())},
                   {"por", block_design::input(at, "por", logic->por())}};
  placed.outputs = {{"feature", &logic->feature_packaging.feature},
                    {"frame_ena", &logic->sensor_input.frame_ena},
                    {"active_threshold", &logic->global_threshold.active_threshold},
                    {"label_overflow", &logic->blob_detection.label_overflow},
                    {"crossing_overflow", &logic->clock_crossing.crossing_overflow},
                    {"feature_overflow", &logic->feature_packaging.feature_overflow},
                    {"bridge_overflow", &logic->axi_threshold_bridge.bridge_overflow}};
  placed.stream_slaves["image"] = {
      [models](vp::AxiStream& link, vp::Clock&) { models->image_stream()(link); }, &system_clk,
      marker_logic::bytes_per_word};
  placed.stream_masters["binary"] = {
      [models](vp::AxiStream& link, vp::Clock&) { models->binary_stream()(link); }, &system_clk,
      marker_logic::bytes_per_word};
  placed.object = std::move(logic);
  return placed;
}

/// Finds what must be around the IP: its programs reach it through these.
class Neighbours {
 public:
  explicit Neighbours(const Surroundings& at) : at_(at) {}

  /// What drives a pin, or sends to a stream, of a part.
  std::string source_of(const PlacedPart& part, const std::string& port) const {
    for (const auto* ends : {&part.pins, &part.buses}) {
      const auto found = ends->find(port);
      if (found != ends->end()) return found->second.part;
    }
    return {};
  }
  /// The first part that takes an output.
  std::string sink_of(const std::string& part, const std::string& port) const {
    const auto is_it = [&](const auto& end) {
      return end.second.part == part && end.second.port == port;
    };
    for (const PlacedPart& other : at_.design.parts) {
      for (const auto* ends : {&other.pins, &other.buses})
        if (std::any_of(ends->begin(), ends->end(), is_it)) return other.name;
    }
    return {};
  }
  template <class T>
  T& part(const std::string& name, const std::string& role) const {
    const bool is_part = !name.empty() && at_.design.part(name);
    T* found = is_part ? dynamic_cast<T*>(at_.placed(name).object.get()) : nullptr;
    if (!found) at_.refuse("its programs need " + role + ", without anything between");
    return *found;
  }

 private:
  const Surroundings& at_;
};

std::uint32_t number(const PlacedPart& part, const std::string& name) {
  const auto* rule = block_design::find_parameter(*block_design::rule_for(part.vlnv), name);
  const auto given = part.parameters.find(name);
  return static_cast<std::uint32_t>(
      std::stoul(given == part.parameters.end() ? rule->usual : given->second));
}

MarkerParts parts_around(const Surroundings& at) {
  const Neighbours near(at);
  const Placed& own = at.placed(at.part.name);
  auto* models = dynamic_cast<pl::FeatureExtraction*>(own.object.get());
  const auto output = [&](const char* name) -> vp::SignalBase& {
    const auto found = own.outputs.find(name);
    if (found == own.outputs.end()) at.refuse(std::string("its RTL has no output ") + name);
    return *found->second;
  };
  const auto clock = [&](const char* pin) -> const vp::Clock& {
    const vp::Clock* found = at.clock_at(pin);
    if (!found) at.refuse(std::string("its pin ") + pin + " needs a clock");
    return *found;
  };
  const std::string control = near.source_of(at.part, "gpio_in");
  const std::string binary = near.sink_of(at.part.name, "binary");
  auto& control_gpio = near.part<xilinx::AxiGpio>(control, "an axi_gpio at its pin gpio_in");
  auto& binary_dma = near.part<xilinx::AxiDma>(binary, "an axi_dma behind its stream binary");
  const pl::Geometry built{number(at.part, "WIDTH"), number(at.part, "HEIGHT"),
                           number(at.part, "BURST_WORDS")};
  return {models,
          models ? models->geometry() : built,
          output("feature"),
          output("frame_ena"),
          output("active_threshold"),
          output("label_overflow"),
          output("crossing_overflow"),
          output("feature_overflow"),
          output("bridge_overflow"),
          clock("system_clk"),
          clock("pixel_clk"),
          near.part<xilinx::ProcSysReset>(near.source_of(at.part, "por"),
                                          "a proc_sys_reset at its pin por"),
          near.part<xilinx::AxiInterconnect>(near.source_of(*at.design.part(control), "S_AXI"),
                                             "an interconnect before the registers of " + control),
          near.part<xilinx::AxiInterconnect>(near.sink_of(binary, "M_AXI_S2MM"),
                                             "an interconnect behind " + binary),
          control_gpio,
          near.part<xilinx::AxiGpio>(near.sink_of(at.part.name, "feature"),
                                     "an axi_gpio behind its pin feature"),
          near.part<xilinx::AxiDma>(near.source_of(at.part, "image"),
                                    "an axi_dma before its stream image"),
          binary_dma};
}

std::unique_ptr<Design> deliver(const Surroundings& at) {
  const MarkerParts parts = parts_around(at);
  arrange(parts);
  return std::make_unique<MarkerWork>(parts, at.ports);
}

}  // namespace

// Its parameters are those of feature_extraction.sv.
block_design::OwnIp marker_ip() {
  block_design::IpRule rule{
      "feature_extraction",
      block_design::Kind::model,
      "corners, threshold and blobs of an image, as feature words (thesis 4.3 and 4.4); RTL in "
      "models/pl",
      {{"WIDTH", "640", {"640"}},
       {"HEIGHT", "480", {"480"}},
       build_option("THRESHOLD", "30", "corner_detection.threshold"),
       {"LEAN", "0", {"0"}},
       build_option("LABELS", "128", "blob_detection.label_count"),
       build_option("MINIMUM_SIDE", "24", "blob_detection.minimum_side"),
       build_option("BUFFER_DEPTH", "100", "feature_packaging.buffer_depth"),
       build_option("FIFO_DEPTH", "64", "axi_threshold_bridge.fifo_depth"),
       build_option("BURST_WORDS", "32", "burst_words")}};
  rule.maker = "markervp:marker";
  return {std::move(rule), place, deliver};
}

}  // namespace platform
