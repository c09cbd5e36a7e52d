#include <marker/designs/improved/improved_logic.h>

#include <blob_stream.h>
#include <marker_logic.h>
#include <vp/error.h>
#include <xilinx/common/axi_lite_ip.h>
#include <initializer_list>

namespace platform {

namespace {

/// An engine that writes packets of up to `bytes` into the DDR, a word a clock or two.
xilinx::AxiDmaBuild packet_writer(std::uint32_t bytes, std::uint32_t burst_words,
                                  std::uint32_t words_per_clock = 1) {
  xilinx::AxiDmaBuild build;
  build.s2mm.memory_bytes = words_per_clock * xilinx::word_bytes;
  build.include_mm2s = false;
  build.s2mm_burst_beats = burst_words;
  build.length_width = marker_logic::bits_for(bytes + 1, 14);
  return build;
}

xilinx::AxiGpioBuild control_outputs() {
  xilinx::AxiGpioBuild build;
  build.gpio.direction = xilinx::GpioDirection::all_outputs;
  return build;
}

/// A stream without a pause needs time for the gaps between bursts: 64 bits of memory a clock.
std::uint32_t memory_words(const pl::Geometry& geometry) {
  return geometry.pixels_per_clock < pl::PixelStream::pixels_per_word ? 1 : 2;
}

const pl::Models<pl::GlobalThreshold>& thresholds(const std::string& rule) {
  if (rule == "otsu") return pl::OtsuThreshold::models();
  return rule == "local" ? pl::LocalThreshold::models() : pl::GlobalThreshold::models();
}

}  // namespace

ImprovedFidelity::ImprovedFidelity(sc_core::sc_module_name name, pl::Fidelity otherwise,
                                   const pl::Models<pl::GlobalThreshold>& thresholds)
    : sc_module(name),
      control_crossing(pl::ControlCrossing::models(), otherwise),
      pixel_crossing("pixel_crossing", pl::StreamCrossing::models(), otherwise),
      blob_crossing("blob_crossing", pl::StreamCrossing::models(), otherwise),
      pixel_stream(pl::PixelStream::models(), otherwise),
      blob_stream(pl::BlobStream::models(), otherwise),
      blob_labelling(pl::BlobLabelling::models(), otherwise),
      threshold(thresholds, otherwise, {&blob_labelling}),
      camera(pl::Camera::models(), otherwise, {&pixel_stream, &threshold}) {}

ImprovedLogic::ImprovedLogic(sc_core::sc_module_name name, vp::Clock& clk, pl::Fidelity otherwise,
                             const pl::Geometry& usual)
    : sc_module(name),
      fidelity("fidelity", otherwise, thresholds(threshold_rule.get())),
      width("width", usual.width, vp::Unit::pixels, vp::Source::decision, "width of a frame"),
      height("height", usual.height, vp::Unit::pixels, vp::Source::decision, "height of a frame"),
      burst_words("burst_words", usual.burst_words, vp::Unit::none,
                  {marker_logic::min_burst_words, marker_logic::max_burst_words},
                  vp::Source::decision,
                  "words of a burst of either DMA to the memory; 2, 4, 8, … 256"),
      camera_clk("camera_clk", clk),
      camera_(fidelity.camera.make({camera_clk.clk(), geometry()})),
      pixel_stream_(fidelity.pixel_stream.make({camera.pixel_clk(), geometry()})),
      threshold_(fidelity.threshold.make({camera.pixel_clk(), geometry()})),
      blob_labelling_(fidelity.blob_labelling.make({camera.pixel_clk(), geometry()})),
      blob_stream_(fidelity.blob_stream.make({camera.pixel_clk(), geometry()})),
      proc_sys_reset("proc_sys_reset", clk),
      axi_interconnect("axi_interconnect", clk),
      axi_mem_interconnect("axi_mem_interconnect", clk),
      axi_gpio_0("axi_gpio_0", clk, control_outputs()),
      axi_dma_0("axi_dma_0", clk,
                packet_writer(geometry().pixels(), burst_words, memory_words(geometry()))),
      axi_dma_1("axi_dma_1", clk, packet_writer(::blob_stream::max_packet_bytes, burst_words)),
      concat("concat", 2) {
  control_block.set_logic_clock(clk);
  make_crossing(clk);
  connect_bus();
  connect_streams();
  name_groups();
  count_work();
}

void ImprovedLogic::make_crossing(vp::Clock& clk) {
  if (&camera.pixel_clk() != &clk) {
    crossing_.emplace(fidelity, pl::Site{camera_clk.clk(), geometry()},
                      pl::Site{camera.pixel_clk(), geometry(), &clk});
    return;
  }
  for (const pl::ChoiceBase* choice : std::initializer_list<const pl::ChoiceBase*>{
           &fidelity.control_crossing, &fidelity.pixel_crossing, &fidelity.blob_crossing}) {
    if (!choice->is_file()) continue;
    throw vp::InputError(choice->name() +
                         ": the camera has the clock of the buses, so nothing crosses; give " +
                         camera_clk.name() + ".frequency, too");
  }
}

void ImprovedLogic::before_end_of_elaboration() {
  for (vp::In<bool>* rst :
       {&camera.rst, &pixel_stream.rst, &threshold.rst, &blob_labelling.rst, &blob_stream.rst}) {
    rst->bind(logic_rst());
  }
  connect_control();
  connect_pixels();
  connect_blobs();
}

void ImprovedLogic::connect_control() {
  if (!crossing_) return connect_control(control_block, proc_sys_reset.peripheral_reset);
  pl::ControlCrossing& control = *crossing_->control_crossing;
  control.ena_in(control_block.ena);
  control.rst_in(control_block.rst_out);
  control.por_in(proc_sys_reset.peripheral_reset);
  control.wr_thresh_in(control_block.wr_thresh);
  control.threshold_in(control_block.threshold);
  connect_control(control, control.por);
}

template <class Control>
void ImprovedLogic::connect_control(Control& control, vp::Signal<bool>& por) {
  camera.ena(control.ena);
  camera.por(por);
  threshold.por(por);
  threshold.wr_thresh(control.wr_thresh);
  threshold.threshold(control.threshold);
}

void ImprovedLogic::connect_pixels() {
  camera.hold(blob_stream.busy);
  pixel_stream.ena(camera.frame_ena);
  pixel_stream.pixel(camera.pixel);
  pixel_stream.more_pixels(camera.more_pixels);
  threshold.frame_ena(camera.frame_ena);
  threshold.pixel(camera.pixel);
  threshold.more_pixels(camera.more_pixels);
  threshold.x(camera.pixel_x);
  threshold.y(camera.pixel_y);
  if (!fidelity.camera.gives().frames) return;
  pixel_stream.frames(camera.frames);
  threshold.frames(camera.frames);
}

void ImprovedLogic::connect_blobs() {
  blob_labelling.ena(threshold.binary_ena);
  blob_labelling.pixel(threshold.binary_out);
  blob_labelling.more_pixels(threshold.more_binary);
  blob_labelling.x(threshold.binary_x);
  blob_labelling.y(threshold.binary_y);
  if (fidelity.threshold.gives().frames) {
    blob_labelling.frames(threshold.binary_frames);
    threshold.binary_frames.take_whole();
  }
  blob_stream.frame_ena(camera.frame_ena);
  blob_stream.frame_number(camera.frame_number);
  blob_stream.threshold(threshold.active_threshold);
  blob_stream.idle(blob_labelling.idle);
  blob_stream.blob_out(blob_labelling.blob_out);
  for (std::size_t i = 0; i < blob_stream.extreme.size(); ++i)
    blob_stream.extreme[i](blob_labelling.extreme[i]);
  blob_stream.label_overflow(blob_labelling.label_overflow);
}

void ImprovedLogic::connect_bus() {
  namespace addresses = marker_logic::addresses;
  control_block.gpio_in(axi_gpio_0.gpio.io_o);
  control_block.por(proc_sys_reset.peripheral_reset);
  axi_interconnect.connect(axi_dma_0.s_axi_lite, addresses::dma_image);
  axi_interconnect.connect(axi_dma_1.s_axi_lite, addresses::dma_binary);
  axi_interconnect.connect(axi_gpio_0.s_axi, addresses::gpio_control);
  axi_gpio_0.s_axi_aresetn(proc_sys_reset.peripheral_aresetn);
  axi_dma_0.axi_resetn(proc_sys_reset.peripheral_aresetn);
  axi_dma_1.axi_resetn(proc_sys_reset.peripheral_aresetn);
  axi_mem_interconnect.connect(axi_dma_0);
  axi_mem_interconnect.connect(axi_dma_1);
  concat.connect_interrupt(axi_dma_0.s2mm_introut, addresses::dma_image_interrupt);
  concat.connect_interrupt(axi_dma_1.s2mm_introut, addresses::dma_binary_interrupt);
}

void ImprovedLogic::connect_streams() {
  axi_dma_0.s2mm().s_axis(pixel_stream_link);
  axi_dma_1.s2mm().s_axis(blob_stream_link);
  if (!crossing_) {
    pixel_stream.m(pixel_stream_link);
    blob_stream.m(blob_stream_link);
    return;
  }
  const auto connect = [this](pl::StreamCrossing& crossing, vp::AxiStreamMaster& from,
                              vp::AxiStream& before, vp::AxiStream& behind) {
    from(before);
    crossing.entry().s(before);
    crossing.m(behind);
    crossing.entry().rst(logic_rst());
  };
  connect(*crossing_->pixel_crossing, pixel_stream.m, crossing_->pixels_before_crossing,
          pixel_stream_link);
  connect(*crossing_->blob_crossing, blob_stream.m, crossing_->blobs_before_crossing,
          blob_stream_link);
}

// In the order of reports.
void ImprovedLogic::name_groups() {
  unsigned place = 0;
  const auto group = [&place](const char* name, std::initializer_list<vp::Ip*> parts) {
    for (vp::Ip* part : parts) part->set_group(name, place++);
  };
  group("feature_extraction", {&camera, &threshold, &blob_labelling});
  group("data_bridge", {&pixel_stream, &blob_stream, &control_block, &axi_dma_0, &axi_dma_1,
                        &axi_gpio_0, &axi_interconnect, &axi_mem_interconnect, &proc_sys_reset});
  if (crossing_)
    group("data_bridge", {crossing_->control_crossing.get(), crossing_->pixel_crossing.get(),
                          crossing_->blob_crossing.get()});
}

void ImprovedLogic::count_work() {
  const auto pixel_words = [this] { return axi_dma_0.beats(); };
  const auto blob_words = [this] { return axi_dma_1.beats(); };
  pixel_stream.set_active_clocks(pixel_words);
  blob_stream.set_active_clocks(blob_words);
  if (crossing_) {
    crossing_->pixel_crossing->set_active_clocks(pixel_words);
    crossing_->blob_crossing->set_active_clocks(blob_words);
    crossing_->control_crossing->set_active_clocks([] { return 0; });
  }
  axi_mem_interconnect.set_active_clocks([=] { return pixel_words() + blob_words(); });
  axi_interconnect.set_active_clocks([this] {
    return xilinx::clocks_per_access *
           (xilinx::accesses(axi_gpio_0.s_axi) + xilinx::accesses(axi_dma_0.s_axi_lite) +
            xilinx::accesses(axi_dma_1.s_axi_lite));
  });
}

void ImprovedLogic::settle_counters() {
  pixel_stream.settle();
  blob_labelling.settle();
}

}  // namespace platform
