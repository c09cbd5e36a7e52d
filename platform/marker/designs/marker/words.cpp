#include <marker/designs/marker/marker_design.h>

#include <marker_logic.h>

namespace platform {

namespace {

using marker_logic::WordFormat;
using Kind = WordFormat::Kind;

Kind kind(std::uint64_t word) {
  return WordFormat::kind(static_cast<std::uint32_t>(word));
}
bool is_corner(std::uint64_t word) {
  return kind(word) == Kind::corner;
}
bool is_blob(std::uint64_t word) {
  return kind(word) == Kind::blob_start;
}

/// `widths`: of the sensor's coordinates.
std::string meaning(std::uint64_t word, const std::vector<unsigned>& widths) {
  const WordFormat format{1u << widths[0], 1u << widths[1]};
  const auto w = static_cast<std::uint32_t>(word);
  const std::string place = std::to_string(format.x(w)) + "," + std::to_string(format.y(w));
  switch (kind(word)) {
    case Kind::end:
      return "?dark red?end of frame";
    case Kind::corner:
      return "?dark blue?corner " + place + " " + "NSEW"[format.direction(w)] + " " +
             std::to_string(format.strength(w));
    case Kind::blob_start:
      return "?dark green?blob " + std::to_string(format.number(w)) + " from " + place;
    case Kind::blob_end:
      break;
  }
  return "?dark green?blob " + std::to_string(format.number(w)) + " to " + place;
}

std::vector<trace::Vocabulary::Group> groups() {
  return {{"Control",
           {"pl.control_block.rst_out", "pl.control_block.ena", "pl.control_block.ready",
            "pl.frame_status.busy", "pl.frame_status.done"}},
          {"Pixels",
           {"pl.sensor_input.frame_ena", "pl.sensor_input.pixel_x", "pl.sensor_input.pixel_y",
            "pl.sensor_input.pixel", "pl.global_threshold.active_threshold"}},
          {"Features",
           {"pl.corner_detection.corner_out", "pl.corner_detection.corner_data",
            "pl.blob_detection.blob_out", "pl.feature_packaging.corner_count",
            "pl.feature_packaging.blob_count", "pl.feature_packaging.feature_overflow",
            "pl.feature_packaging.feature"}},
          {"Binary image",
           {"pl.binary_stream.tvalid", "pl.binary_stream.tready", "pl.binary_stream.tlast",
            "pl.binary_stream.tdata", "pl.axi_threshold_bridge.fifo_count",
            "pl.axi_threshold_bridge.bridge_overflow"}},
          {"Image upload",
           {"pl.image_stream.tvalid", "pl.image_stream.tready", "pl.image_stream.tlast",
            "pl.image_stream.tdata"}}};
}

trace::Vocabulary make() {
  trace::Vocabulary v;
  v.start = "pl.control_block.ena";
  v.word = "pl.feature_packaging.feature";
  v.word_kinds = {{"corners", is_corner}, {"blobs", is_blob}};
  v.meaning = meaning;
  v.fields = {"pl.sensor_input.pixel_x", "pl.sensor_input.pixel_y"};
  // Usual depths: thesis 4.4.3; decision of the bridge.
  v.buffers = {{"pl.feature_packaging.corner_count", "pl.feature_packaging.depth", 100},
               {"pl.feature_packaging.blob_count", "pl.feature_packaging.depth", 100},
               {"pl.axi_threshold_bridge.fifo_count", "pl.axi_threshold_bridge.depth", 64}};
  v.losses = {{"feature_overflow", "pl.feature_packaging.feature_overflow"},
              {"label_overflow", "pl.blob_detection.label_overflow"},
              {"bridge_overflow", "pl.axi_threshold_bridge.bridge_overflow"},
              {"crossing_overflow", "pl.clock_crossing.crossing_overflow"}};
  v.unplayed = {{"pl.fidelity.sensor_input", "pl.sensor_input.pixel, .pixel_x, .pixel_y"},
                {"pl.fidelity.axi_image_store", "pl.image_stream.*"},
                {"pl.fidelity.global_threshold", "pl.global_threshold.thresh_*, .binary_*"},
                {"pl.fidelity.axi_threshold_bridge",
                 "pl.clock_crossing.binary.*, pl.axi_threshold_bridge.thresh_seen, .fifo_count, "
                 "pl.binary_stream.*, pl.always"}};
  v.interrupts = {{"pl.axi_dma_0.mm2s_introut", marker_logic::addresses::dma_image_interrupt,
                   "DMA 0: image", "dark blue"},
                  {"pl.axi_dma_1.s2mm_introut", marker_logic::addresses::dma_binary_interrupt,
                   "DMA 1: binary image", "dark red"}};
  v.irq_f2p = "pl.concat.dout";
  v.functions = {"upload",
                 "capture",
                 "receive",
                 "feature_evaluation",
                 {"rectification", "identification"},
                 "pose_estimation",
                 "pose_us"};
  v.groups = groups();
  v.translated = {{"pl.concat.dout", "interrupt_lines.flt"},
                  {"pl.corner_detection.new_direction", "direction.flt"},
                  {"pl.corner_detection.centre_direction", "direction.flt"},
                  {"pl.corner_detection.corner_data", v.words},
                  {"pl.blob_detection.blob_start", v.words},
                  {"pl.blob_detection.blob_end", v.words},
                  {"pl.clock_crossing.corner.word", v.words},
                  {"pl.clock_crossing.blob.word", v.words},
                  {"pl.clock_crossing.blob.second_word", v.words},
                  {"pl.feature_packaging.feature", v.words}};
  v.files = {{"interrupt_lines.flt",
              "0 -\n1 ?dark blue?image\n2 ?dark red?binary image\n3 ?purple4?both\n"},
             // Thesis table 4.4.
             {"direction.flt", "0 North\n1 South\n2 East\n3 West\n"}};
  return v;
}

}  // namespace

const trace::Vocabulary& marker_words() {
  static const trace::Vocabulary words = make();
  return words;
}

}  // namespace platform
