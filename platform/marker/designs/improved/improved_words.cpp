#include <marker/designs/improved/improved_design.h>

#include <marker_logic.h>

namespace platform {

namespace {

trace::Vocabulary make_improved_words() {
  trace::Vocabulary v;
  v.start = "pl.control_block.ena";
  // Usual depth: decision of the stream.
  v.buffers = {{"pl.blob_stream.fifo_count", "pl.blob_stream.depth", 512}};
  v.losses = {{"dropped_triggers", "pl.camera.dropped_triggers"},
              {"dropped_pictures", "pl.pixel_stream.dropped_frames"},
              {"cut_pictures", "pl.pixel_stream.cut_frames"},
              {"dropped_packets", "pl.blob_stream.dropped_frames"},
              {"lost_in_logic", "pl.blob_labelling.label_overflow"}};
  v.interrupts = {{"pl.axi_dma_0.s2mm_introut", marker_logic::addresses::dma_image_interrupt,
                   "DMA 0: picture", "dark blue"},
                  {"pl.axi_dma_1.s2mm_introut", marker_logic::addresses::dma_binary_interrupt,
                   "DMA 1: blobs", "dark red"}};
  v.irq_f2p = "pl.concat.dout";
  v.groups = {{"Control",
               {"pl.control_block.rst_out", "pl.control_block.ena", "pl.camera.frame_number",
                "pl.blob_stream.busy"}},
              {"Pixels",
               {"pl.camera.frame_ena", "pl.camera.pixel_x", "pl.camera.pixel_y", "pl.camera.pixel",
                "pl.local_threshold.binary_ena", "pl.local_threshold.binary_out",
                "pl.otsu_threshold.active_threshold"}},
              {"Picture",
               {"pl.pixels.tvalid", "pl.pixels.tready", "pl.pixels.tlast", "pl.pixels.tdata",
                "pl.pixel_stream.fifo_count", "pl.pixel_stream.dropped_frames"}},
              {"Blobs",
               {"pl.blob_labelling.blob_out", "pl.blob_labelling.extreme_0",
                "pl.blob_labelling.idle", "pl.blobs.tvalid", "pl.blobs.tready", "pl.blobs.tlast",
                "pl.blobs.tdata", "pl.blob_stream.fifo_count"}}};
  v.translated = {{"pl.concat.dout", "interrupt_lines.flt"}};
  v.files = {
      {"interrupt_lines.flt", "0 -\n1 ?dark blue?picture\n2 ?dark red?blobs\n3 ?purple4?both\n"}};
  return v;
}

}  // namespace

const trace::Vocabulary& improved_words() {
  static const trace::Vocabulary words = make_improved_words();
  return words;
}

}  // namespace platform
