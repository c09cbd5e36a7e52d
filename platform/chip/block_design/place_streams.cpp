#include <map>
#include <memory>
#include <string>
#include <utility>

#include <chip/block_design/place_ports.h>
#include <xilinx/axis_buffer/axis_buffer.h>
#include <xilinx/axis_clock_fifo/axis_clock_fifo.h>
#include <xilinx/axis_fan/axis_fan.h>
#include <xilinx/axis_subset_converter/axis_subset_converter.h>
#include <xilinx/fifo_generator/fifo_generator.h>

// IP of streams with more than a buffer, and FIFOs.
namespace platform::block_design {

namespace {

/// A FIFO of a stream between two clocks.
Placed place_clock_fifo(const Placement& at, xilinx::AxisClockFifoBuild build, const char* from,
                        const char* to, const std::vector<std::string>& resets) {
  build.bytes = word(at, "TDATA_NUM_BYTES");
  build.user = word(at, "TUSER_WIDTH");
  build.id = word(at, "TID_WIDTH");
  build.dest = word(at, "TDEST_WIDTH");
  vp::Clock &in = at.clock({from}), &out = at.clock({to});
  auto fifo = std::make_unique<xilinx::AxisClockFifo>(at.part.name.c_str(), in, out, build);
  xilinx::AxisClockFifo* model = fifo.get();
  Placed placed;
  placed.inputs[resets.front()] = input(at, resets.front(), fifo->aresetn);
  // Both resets are one signal in each clock: the first one empties the FIFO.
  for (std::size_t i = 1; i < resets.size(); ++i) placed.unused_inputs.insert(resets[i]);
  placed.stream_slaves["S_AXIS"] = {
      [model](vp::AxiStream& link, vp::Clock&) { model->s_axis(link); }, &in, build.bytes};
  placed.stream_masters["M_AXIS"] = {
      [model](vp::AxiStream& link, vp::Clock&) { model->m_axis()(link); }, &out, build.bytes};
  placed.object = std::move(fifo);
  return placed;
}

Placed place_async_fifo(const Placement& at) {
  xilinx::AxisClockFifoBuild build;
  build.depth = word(at, "FIFO_DEPTH");
  build.strobe = at.flag("HAS_TSTRB") ? word(at, "TDATA_NUM_BYTES") : 0;
  return place_clock_fifo(at, build, "s_axis_aclk", "m_axis_aclk",
                          {"s_axis_aresetn", "m_axis_aresetn"});
}

Placed place_clock_converter(const Placement& at) {
  xilinx::AxisClockFifoBuild build;
  build.strobe = at.flag("HAS_TSTRB") ? word(at, "TDATA_NUM_BYTES") : 0;
  return place_clock_fifo(at, build, "s_axis_aclk", "m_axis_aclk",
                          {"s_axis_aresetn", "m_axis_aresetn"});
}

xilinx::AxisSubsetEnd subset_end(const Placement& at, const std::string& end) {
  return {word(at, end + "_TDATA_NUM_BYTES"), word(at, end + "_TUSER_WIDTH"),
          word(at, end + "_TID_WIDTH"), word(at, end + "_TDEST_WIDTH")};
}

Placed place_subset_converter(const Placement& at) {
  xilinx::AxisSubsetConverterBuild build;
  build.in = subset_end(at, "S");
  build.out = subset_end(at, "M");
  build.data = at.text("TDATA_REMAP");
  if (build.out.user != 0) build.user = at.text("TUSER_REMAP");
  if (build.out.id != 0) build.id = at.text("TID_REMAP");
  if (build.out.dest != 0) build.dest = at.text("TDEST_REMAP");
  if (at.flag("M_HAS_TKEEP")) build.keep = at.text("TKEEP_REMAP");
  build.last = at.flag("M_HAS_TLAST") ? at.text("TLAST_REMAP") : "1'b0";
  build.default_last = word(at, "DEFAULT_TLAST");
  vp::Clock& clock = at.clock({"aclk"});
  auto converter =
      std::make_unique<xilinx::AxisSubsetConverter>(at.part.name.c_str(), clock, build);
  xilinx::AxisSubsetConverter* model = converter.get();
  Placed placed;
  placed.inputs = {{"aresetn", input(at, "aresetn", converter->aresetn)}};
  placed.stream_slaves["S_AXIS"] = {
      [model](vp::AxiStream& link, vp::Clock&) { model->s_axis(link); }, &clock, build.in.bytes};
  placed.stream_masters["M_AXIS"] = {
      [model](vp::AxiStream& link, vp::Clock&) { model->m_axis(link); }, &clock, build.out.bytes};
  placed.object = std::move(converter);
  return placed;
}

std::string two_digits(unsigned number) {
  return (number < 10 ? "0" : "") + std::to_string(number);
}

Placed place_broadcaster(const Placement& at) {
  const std::uint32_t in = word(at, "S_TDATA_NUM_BYTES"), out = word(at, "M_TDATA_NUM_BYTES");
  std::vector<std::string> remaps;
  for (unsigned n = 0; n < word(at, "NUM_MI"); ++n)
    remaps.push_back(at.text("M" + two_digits(n) + "_TDATA_REMAP"));
  vp::Clock& clock = at.clock({"aclk"});
  auto fan = std::make_unique<xilinx::AxisBroadcaster>(at.part.name.c_str(), clock, in, out,
                                                       word(at, "S_TUSER_WIDTH"), remaps);
  xilinx::AxisBroadcaster* model = fan.get();
  Placed placed;
  placed.inputs = {{"aresetn", input(at, "aresetn", fan->aresetn)}};
  placed.stream_slaves["S_AXIS"] = {
      [model](vp::AxiStream& link, vp::Clock&) { model->s_axis(link); }, &clock, in};
  for (unsigned n = 0; n < remaps.size(); ++n)
    placed.stream_masters["M" + two_digits(n) + "_AXIS"] = {
        [model, n](vp::AxiStream& link, vp::Clock&) { model->m_axis(n)(link); }, &clock, out};
  placed.object = std::move(fan);
  return placed;
}

Placed place_combiner(const Placement& at) {
  const std::uint32_t inputs = word(at, "NUM_SI"), bytes = word(at, "TDATA_NUM_BYTES");
  vp::Clock& clock = at.clock({"aclk"});
  auto fan =
      std::make_unique<xilinx::AxisCombiner>(at.part.name.c_str(), clock, inputs, bytes,
                                             word(at, "TUSER_WIDTH"), word(at, "MASTER_PORT_NUM"));
  xilinx::AxisCombiner* model = fan.get();
  Placed placed;
  placed.inputs = {{"aresetn", input(at, "aresetn", fan->aresetn)}};
  for (unsigned n = 0; n < inputs; ++n)
    placed.stream_slaves["S" + two_digits(n) + "_AXIS"] = {
        [model, n](vp::AxiStream& link, vp::Clock&) { model->s_axis(n)(link); }, &clock, bytes};
  placed.stream_masters["M_AXIS"] = {
      [model](vp::AxiStream& link, vp::Clock&) { model->m_axis(link); }, &clock, inputs * bytes};
  placed.object = std::move(fan);
  return placed;
}

/// One of the FIFO generator with AXI4-Stream ports.
Placed place_generated_stream(const Placement& at) {
  const std::uint32_t depth = word(at, "Input_Depth_axis");
  if (at.text("FIFO_Implementation_axis").rfind("Independent", 0) == 0) {
    xilinx::AxisClockFifoBuild build;
    build.depth = depth;
    return place_clock_fifo(at, build, "s_aclk", "m_aclk", {"s_aresetn"});
  }
  xilinx::AxisBufferBuild build;
  build.in_bytes = build.out_bytes = word(at, "TDATA_NUM_BYTES");
  build.depth = depth;
  build.user = word(at, "TUSER_WIDTH");
  build.id = word(at, "TID_WIDTH");
  build.dest = word(at, "TDEST_WIDTH");
  vp::Clock& clock = at.clock({"s_aclk"});
  auto buffer = std::make_unique<xilinx::AxisBuffer>(at.part.name.c_str(), clock, build);
  xilinx::AxisBuffer* model = buffer.get();
  Placed placed;
  placed.inputs = {{"s_aresetn", input(at, "s_aresetn", buffer->aresetn)}};
  placed.stream_slaves["S_AXIS"] = {
      [model](vp::AxiStream& link, vp::Clock&) { model->s_axis(link); }, &clock, build.in_bytes};
  placed.stream_masters["M_AXIS"] = {
      [model](vp::AxiStream& link, vp::Clock&) { model->m_axis(link); }, &clock, build.out_bytes};
  placed.object = std::move(buffer);
  return placed;
}

Placed place_fifo_generator(const Placement& at) {
  if (unquoted(at.text("INTERFACE_TYPE")) != "Native") return place_generated_stream(at);
  xilinx::FifoGeneratorBuild build;
  build.width = word(at, "C_DIN_WIDTH");
  build.depth = word(at, "C_WR_DEPTH");
  build.common_clock = at.flag("C_COMMON_CLOCK");
  build.first_word_fall_through = word(at, "C_PRELOAD_LATENCY") == 0;
  build.synchroniser_stages = word(at, "C_SYNCHRONIZER_STAGE");
  vp::Clock& write = build.common_clock ? at.clock({"clk"}) : at.clock({"wr_clk"});
  vp::Clock& read = build.common_clock ? write : at.clock({"rd_clk"});
  auto fifo = std::make_unique<xilinx::FifoGenerator>(at.part.name.c_str(), write, read, build);
  auto& reader = fifo->reader();
  Placed placed;
  placed.inputs = {{"wr_en", input(at, "wr_en", fifo->wr_en)},
                   {"din", input(at, "din", fifo->din)},
                   {"rd_en", input(at, "rd_en", reader.rd_en)}};
  // It has one of them at most.
  for (const char* pin : {"srst", "rst"}) placed.inputs[pin] = input(at, pin, fifo->reset);
  placed.outputs = {{"full", &fifo->full},           {"almost_full", &fifo->almost_full},
                    {"wr_ack", &fifo->wr_ack},       {"overflow", &fifo->overflow},
                    {"dout", &reader.dout},          {"empty", &reader.empty},
                    {"valid", &reader.valid},        {"almost_empty", &reader.almost_empty},
                    {"underflow", &reader.underflow}};
  placed.object = std::move(fifo);
  return placed;
}

}  // namespace

Placer stream_placer(const Placement& at) {
  const std::string& ip = at.part.rule()->ip;
  if (ip == "axis_data_fifo") return at.flag("IS_ACLK_ASYNC") ? place_async_fifo : nullptr;
  static const std::map<std::string, Placer> placers{
      {"axis_broadcaster", place_broadcaster},
      {"axis_clock_converter", place_clock_converter},
      {"axis_combiner", place_combiner},
      {"axis_subset_converter", place_subset_converter},
      {"fifo_generator", place_fifo_generator}};
  const auto found = placers.find(ip);
  return found == placers.end() ? nullptr : found->second;
}

}  // namespace platform::block_design
