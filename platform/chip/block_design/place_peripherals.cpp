#include <algorithm>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include <chip/block_design/place_ports.h>
#include <xilinx/axi_cdma/axi_cdma.h>
#include <xilinx/axi_fifo_mm_s/axi_fifo_mm_s.h>
#include <xilinx/axi_iic/axi_iic.h>
#include <xilinx/axi_intc/axi_intc.h>
#include <xilinx/axi_quad_spi/axi_quad_spi.h>
#include <xilinx/axi_timer/axi_timer.h>
#include <xilinx/axi_uartlite/axi_uartlite.h>
#include <xilinx/axi_vdma/axi_vdma.h>
#include <xilinx/xadc_wiz/xadc_wiz.h>

// The small IP of registers: each with the vendor's names of pins and buses.
namespace platform::block_design {

namespace {

const char* name_of(const Placement& at) {
  return at.part.name.c_str();
}

/// Inputs from the board, whose devices are wired to the model as a whole. One that a part of the
/// design drives is refused: the model has no levels there.
void leave_to_board(const Placement& at, Placed& placed) {
  const std::string& ip = at.part.rule()->ip;
  for (const std::string& pin : board_inputs(ip)) {
    placed.unused_inputs.insert(pin);
    const auto source = at.part.pins.find(pin);
    const PlacedPart* driver =
        source == at.part.pins.end() ? nullptr : at.design.part(source->second.part);
    if (!driver || may_drive_board_input(ip, driver->vlnv, source->second.port)) continue;
    at.refuse("its pin " + pin + " is driven by " + source->second.text() +
              ", and its model takes devices of the board only: 'as: stub' leaves it out");
  }
}

Placed place_timer(const Placement& at) {
  xilinx::AxiTimerBuild build;
  build.count_width = word(at, "C_COUNT_WIDTH");
  build.one_timer_only = at.flag("C_ONE_TIMER_ONLY");
  auto timer = std::make_unique<xilinx::AxiTimer>(name_of(at), at.clock({"s_axi_aclk"}), build);
  Placed placed;
  placed.slaves = {{"S_AXI", registers(timer->s_axi)}};
  placed.inputs = {
      {"s_axi_aresetn", input(at, "s_axi_aresetn", timer->s_axi_aresetn)},
      {"capturetrig0", input(at, "capturetrig0", timer->capturetrig0, !at.flag("C_TRIG0_ASSERT"))},
      {"capturetrig1", input(at, "capturetrig1", timer->capturetrig1, !at.flag("C_TRIG1_ASSERT"))}};
  placed.outputs = {
      {"generateout0", output(at, "generateout0", timer->generateout0, !at.flag("C_GEN0_ASSERT"))},
      {"generateout1", output(at, "generateout1", timer->generateout1, !at.flag("C_GEN1_ASSERT"))},
      {"pwm0", &timer->pwm0},
      {"interrupt", &timer->interrupt}};
  placed.object = std::move(timer);
  return placed;
}

/// Each bit of `intr` is an input of its own; a falling edge, or a low level, is the inverse.
void join_interrupts(const Placement& at, xilinx::AxiIntc& intc, std::uint32_t inverted,
                     vp::SignalBase& source) {
  for (unsigned n = 0; n < intc.num_intr_inputs && n < source.width(); ++n) {
    const std::string name = at.part.name + "_intr" + std::to_string(n);
    auto bit = xilinx::make_slice((name + "_bit").c_str(), n, n);
    bit->connect(0, source);
    input(at, "intr" + std::to_string(n), intc.intr(n), (inverted >> n & 1) != 0)(bit->out);
    at.adapters.push_back(std::move(bit));
  }
}

Placed place_intc(const Placement& at) {
  xilinx::AxiIntcBuild build;
  build.num_intr_inputs = word(at, "C_NUM_INTR_INPUTS");
  build.kind_of_intr = word(at, "C_KIND_OF_INTR");
  const std::uint32_t edges = build.kind_of_intr;
  const std::uint32_t inverted =
      (edges & ~word(at, "C_KIND_OF_EDGE")) | (~edges & ~word(at, "C_KIND_OF_LVL"));
  auto intc = std::make_unique<xilinx::AxiIntc>(name_of(at), at.clock({"s_axi_aclk"}), build);
  Placed placed;
  placed.slaves = {{"s_axi", registers(intc->s_axi)}};
  placed.inputs = {{"s_axi_aresetn", input(at, "s_axi_aresetn", intc->s_axi_aresetn)},
                   {"intr", [at, inverted, &controller = *intc](vp::SignalBase& source) {
                      join_interrupts(at, controller, inverted, source);
                    }}};
  placed.outputs = {{"irq", output(at, "irq", intc->irq, !at.flag("C_IRQ_ACTIVE"))}};
  placed.object = std::move(intc);
  return placed;
}

// Its pins are the bus of `board::I2cBus`.
Placed place_iic(const Placement& at) {
  xilinx::AxiIicBuild build;
  build.iic_freq = word(at, "C_IIC_FREQ");
  build.gpo_width = word(at, "C_GPO_WIDTH");
  build.gpo_default = word(at, "C_DEFAULT_VALUE");
  auto iic = std::make_unique<xilinx::AxiIic>(name_of(at), at.clock({"s_axi_aclk"}), build);
  Placed placed;
  placed.slaves = {{"S_AXI", registers(iic->s_axi)}};
  placed.inputs = {{"s_axi_aresetn", input(at, "s_axi_aresetn", iic->s_axi_aresetn)}};
  leave_to_board(at, placed);
  placed.outputs = {{"iic2intc_irpt", &iic->iic2intc_irpt}, {"gpo", &iic->gpo}};
  placed.object = std::move(iic);
  return placed;
}

Placed place_uartlite(const Placement& at) {
  xilinx::AxiUartliteBuild build;
  build.baudrate = word(at, "C_BAUDRATE");
  build.data_bits = word(at, "C_DATA_BITS");
  build.use_parity = at.flag("C_USE_PARITY");
  build.odd_parity = at.flag("C_ODD_PARITY");
  auto uart = std::make_unique<xilinx::AxiUartlite>(name_of(at), at.clock({"s_axi_aclk"}), build);
  Placed placed;
  placed.slaves = {{"S_AXI", registers(uart->s_axi)}};
  placed.inputs = {{"s_axi_aresetn", input(at, "s_axi_aresetn", uart->s_axi_aresetn)}};
  leave_to_board(at, placed);
  placed.outputs = {{"interrupt", &uart->interrupt}};
  placed.serial = uart.get();
  placed.object = std::move(uart);
  return placed;
}

Placed place_quad_spi(const Placement& at) {
  xilinx::AxiQuadSpiBuild build;
  build.sck_ratio = word(at, "C_SCK_RATIO");
  build.num_ss_bits = word(at, "C_NUM_SS_BITS");
  build.fifo_depth = word(at, "C_FIFO_DEPTH");
  build.num_transfer_bits = word(at, "C_NUM_TRANSFER_BITS");
  auto spi = std::make_unique<xilinx::AxiQuadSpi>(name_of(at), at.clock({"s_axi_aclk"}), build,
                                                  &at.clock({"ext_spi_clk"}));
  Placed placed;
  placed.slaves = {{"AXI_LITE", registers(spi->s_axi)}};
  placed.inputs = {{"s_axi_aresetn", input(at, "s_axi_aresetn", spi->s_axi_aresetn)}};
  leave_to_board(at, placed);
  placed.outputs = {{"ip2intc_irpt", &spi->ip2intc_irpt}};
  placed.object = std::move(spi);
  return placed;
}

Placed place_stream_fifo(const Placement& at) {
  xilinx::AxiFifoMmSBuild build;
  build.use_tx_data = at.flag("C_USE_TX_DATA");
  build.use_rx_data = at.flag("C_USE_RX_DATA");
  build.tx_fifo_depth = word(at, "C_TX_FIFO_DEPTH");
  build.rx_fifo_depth = word(at, "C_RX_FIFO_DEPTH");
  build.has_tkeep = at.flag("C_HAS_AXIS_TKEEP");
  vp::Clock& clock = at.clock({"s_axi_aclk"});
  auto fifo = std::make_unique<xilinx::AxiFifoMmS>(name_of(at), clock, build);
  constexpr unsigned word_bytes = 4;
  Placed placed;
  xilinx::AxiFifoMmS* streams = fifo.get();
  placed.slaves = {{"S_AXI", registers(fifo->s_axi)}};
  placed.inputs = {{"s_axi_aresetn", input(at, "s_axi_aresetn", fifo->s_axi_aresetn)}};
  placed.outputs = {{"interrupt", &fifo->interrupt}};
  if (build.use_tx_data) {
    placed.stream_masters["AXI_STR_TXD"] = {
        [streams](vp::AxiStream& link, vp::Clock&) { streams->axi_str_txd(link); }, &clock,
        word_bytes};
  }
  if (build.use_rx_data) {
    placed.stream_slaves["AXI_STR_RXD"] = {
        [streams](vp::AxiStream& link, vp::Clock&) { streams->axi_str_rxd(link); }, &clock,
        word_bytes};
  }
  placed.object = std::move(fifo);
  return placed;
}

Placed place_cdma(const Placement& at) {
  constexpr std::uint32_t bits_per_byte = 8;
  xilinx::AxiCdmaBuild build;
  build.burst_beats = word(at, "C_M_AXI_MAX_BURST_LEN");
  build.memory_bytes = word(at, "C_M_AXI_DATA_WIDTH") / bits_per_byte;
  auto cdma = std::make_unique<xilinx::AxiCdma>(name_of(at),
                                                at.clock({"m_axi_aclk", "s_axi_lite_aclk"}), build);
  Placed placed;
  placed.slaves = {{"S_AXI_LITE", registers(cdma->s_axi_lite)}};
  placed.masters = {{"M_AXI", memory_master(cdma->m_axi)}};
  placed.inputs = {{"s_axi_lite_aresetn", input(at, "s_axi_lite_aresetn", cdma->s_axi_aresetn)}};
  placed.outputs = {{"cdma_introut", &cdma->cdma_introut}};
  placed.object = std::move(cdma);
  return placed;
}

xilinx::VdmaChannelBuild vdma_channel(const Placement& at, const std::string& channel,
                                      const std::string& stream) {
  constexpr std::uint32_t bits_per_byte = 8, least_buffer = 128;
  xilinx::VdmaChannelBuild build;
  build.include = at.flag("C_INCLUDE_" + channel);
  build.genlock = static_cast<xilinx::GenlockMode>(at.number("C_" + channel + "_GENLOCK_MODE"));
  build.memory_bytes = word(at, "C_M_AXI_" + channel + "_DATA_WIDTH") / bits_per_byte;
  build.stream_bytes = word(at, stream + "_TDATA_WIDTH") / bits_per_byte;
  build.burst_beats = word(at, "C_" + channel + "_MAX_BURST_LENGTH");
  build.line_buffer = std::max(least_buffer, word(at, "C_" + channel + "_LINEBUFFER_DEPTH"));
  build.dre = at.flag("C_INCLUDE_" + channel + "_DRE");
  return build;
}

Placed place_vdma(const Placement& at) {
  xilinx::AxiVdmaBuild build;
  build.frame_stores = word(at, "C_NUM_FSTORES");
  build.mm2s = vdma_channel(at, "MM2S", "C_M_AXIS_MM2S");
  build.s2mm = vdma_channel(at, "S2MM", "C_S_AXIS_S2MM");
  vp::Clock& registers_clock = at.clock({"s_axi_lite_aclk"});
  vp::Clock& reads =
      build.mm2s.include ? at.clock({"m_axi_mm2s_aclk", "m_axis_mm2s_aclk"}) : registers_clock;
  vp::Clock& writes =
      build.s2mm.include ? at.clock({"m_axi_s2mm_aclk", "s_axis_s2mm_aclk"}) : registers_clock;
  auto vdma = std::make_unique<xilinx::AxiVdma>(name_of(at), registers_clock, reads, writes, build);
  Placed placed;
  placed.slaves = {{"S_AXI_LITE", registers(vdma->s_axi_lite)}};
  placed.inputs = {{"axi_resetn", input(at, "axi_resetn", vdma->axi_resetn)}};
  // Frame pointers are for genlock with another core, of which the model warns when it is asked
  // for.
  placed.unused_inputs = {"mm2s_frame_ptr_in", "s2mm_frame_ptr_in"};
  placed.outputs = {{"mm2s_introut", &vdma->mm2s_introut}, {"s2mm_introut", &vdma->s2mm_introut}};
  if (xilinx::VdmaReader* mm2s = vdma->mm2s()) {
    placed.masters["M_AXI_MM2S"] = memory_master(mm2s->m_axi);
    placed.stream_masters["M_AXIS_MM2S"] = {
        [mm2s](vp::AxiStream& link, vp::Clock&) { mm2s->m_axis(link); }, &reads,
        build.mm2s.stream_bytes};
  }
  if (xilinx::VdmaWriter* s2mm = vdma->s2mm()) {
    placed.masters["M_AXI_S2MM"] = memory_master(s2mm->m_axi);
    placed.stream_slaves["S_AXIS_S2MM"] = {
        [s2mm](vp::AxiStream& link, vp::Clock&) { s2mm->s_axis(link); }, &writes,
        build.s2mm.stream_bytes};
  }
  placed.object = std::move(vdma);
  return placed;
}

/// What the converter's registers from 0x40 on hold after configuration (UG480): three of
/// configuration, 0x48 to 0x4F the sequence, 0x50 to 0x5F the limits of alarms.
std::map<unsigned, std::uint16_t> converter_registers(const Placement& at) {
  std::map<unsigned, std::uint16_t> words;
  const auto add = [&](unsigned first, const std::string& name, unsigned count) {
    for (unsigned n = 0; n < count; ++n)
      words[first + n] = static_cast<std::uint16_t>(at.number(name + std::to_string(n)));
  };
  add(0x40, "C_CONFIGURATION_R", 3);
  add(0x48, "C_SEQUENCE_R", 8);
  add(0x50, "C_ALARM_LIMIT_R", 16);
  return words;
}

Placed place_xadc(const Placement& at) {
  constexpr unsigned divisor_shift = 8;
  xilinx::XadcWizBuild build;
  build.initial = converter_registers(at);
  build.adcclk_divisor = build.initial.at(0x42) >> divisor_shift;
  const int channels =
      __builtin_popcount(build.initial.at(0x48)) + __builtin_popcount(build.initial.at(0x49));
  if (at.text("SEQUENCER_MODE") == "Continuous" && channels > 0)
    build.sequence_channels = static_cast<std::uint32_t>(channels);
  auto wizard = std::make_unique<xilinx::XadcWiz>(name_of(at), at.clock({"s_axi_aclk"}), build);
  Placed placed;
  placed.slaves = {{"s_axi_lite", registers(wizard->s_axi_lite)}};
  placed.inputs = {{"s_axi_aresetn", input(at, "s_axi_aresetn", wizard->s_axi_aresetn)}};
  leave_to_board(at, placed);
  placed.outputs = {{"ip2intc_irpt", &wizard->ip2intc_irpt}, {"alarm_out", &wizard->alarm_out}};
  for (auto& pin : wizard->alarm) placed.outputs[pin.basename()] = &pin;
  placed.object = std::move(wizard);
  return placed;
}

}  // namespace

const PlacedPart* serial_driver(const DesignFile& design, const PlacedPart& part) {
  const auto rx = part.pins.find("rx");
  const PlacedPart* driver = rx == part.pins.end() ? nullptr : design.part(rx->second.part);
  const IpRule* rule = driver ? driver->rule() : nullptr;
  return rule && rule->ip == "axi_uartlite" && rx->second.port == "tx" ? driver : nullptr;
}

Placer peripheral_placer(const std::string& ip) {
  static const std::map<std::string, Placer> placers{
      {"axi_cdma", place_cdma},   {"axi_fifo_mm_s", place_stream_fifo},
      {"axi_vdma", place_vdma},   {"axi_iic", place_iic},
      {"axi_intc", place_intc},   {"axi_quad_spi", place_quad_spi},
      {"axi_timer", place_timer}, {"axi_uartlite", place_uartlite},
      {"xadc_wiz", place_xadc}};
  const auto found = placers.find(ip);
  return found == placers.end() ? nullptr : found->second;
}

}  // namespace platform::block_design
