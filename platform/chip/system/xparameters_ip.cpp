#include <chip/system/xparameters.h>

#include <vp/text.h>
#include <xilinx/axi_bram_ctrl/axi_bram_ctrl.h>
#include <xilinx/axi_cdma/axi_cdma.h>
#include <xilinx/axi_dma/axi_dma.h>
#include <xilinx/axi_fifo_mm_s/axi_fifo_mm_s.h>
#include <xilinx/axi_gpio/axi_gpio.h>
#include <xilinx/axi_iic/axi_iic.h>
#include <xilinx/axi_intc/axi_intc.h>
#include <xilinx/axi_quad_spi/axi_quad_spi.h>
#include <xilinx/axi_timer/axi_timer.h>
#include <xilinx/axi_uartlite/axi_uartlite.h>
#include <xilinx/axi_vdma/axi_vdma.h>
#include <xilinx/clk_wiz/clk_wiz.h>
#include <xilinx/register_stub/register_stub.h>
#include <xilinx/v_tc/v_tc.h>
#include <xilinx/xadc_wiz/xadc_wiz.h>

namespace xparameters {

namespace {

std::uint32_t hz(const vp::Clocked& module) {
  return static_cast<std::uint32_t>(module.clock().frequency_hz());
}

void add_dma(Device& device, const xilinx::AxiDma& dma) {
  constexpr std::uint32_t address_width = 32;
  const std::uint32_t mm2s_width = 8 * dma.mm2s_widths.memory_bytes;
  const std::uint32_t s2mm_width = 8 * dma.s2mm_widths.memory_bytes;
  const std::uint32_t mm2s_dre = dma.mm2s_dre.get(), s2mm_dre = dma.s2mm_dre.get();
  const std::uint32_t reads = dma.mm2s_burst_beats, writes = dma.s2mm_burst_beats;
  const std::uint32_t mm2s = dma.include_mm2s.get(), s2mm = dma.include_s2mm.get();
  const std::uint32_t sg = dma.include_sg.get(), length_width = dma.length_width;
  device.driver = "AXIDMA";
  device.compatible = "xlnx,axi-dma-7.1";
  device.options = {{"SG_INCLUDE_STSCNTRL_STRM", 0},
                    {"INCLUDE_MM2S", mm2s},
                    {"INCLUDE_MM2S_DRE", mm2s_dre},
                    {"M_AXI_MM2S_DATA_WIDTH", mm2s_width},
                    {"INCLUDE_S2MM", s2mm},
                    {"INCLUDE_S2MM_DRE", s2mm_dre},
                    {"M_AXI_S2MM_DATA_WIDTH", s2mm_width},
                    {"INCLUDE_SG", sg},
                    {"ENABLE_MULTI_CHANNEL", 0},
                    {"NUM_MM2S_CHANNELS", 1},
                    {"NUM_S2MM_CHANNELS", 1},
                    {"MM2S_BURST_SIZE", reads},
                    {"S2MM_BURST_SIZE", writes},
                    {"MICRO_DMA", 0},
                    {"ADDR_WIDTH", address_width},
                    {"SG_LENGTH_WIDTH", length_width},
                    {"c_addr_width", address_width},
                    {"c_sg_length_width", length_width}};
  device.sdt_options = {{"SG_INCLUDE_STSCNTRL_STRM", 0}, {"INCLUDE_MM2S", mm2s},
                        {"INCLUDE_MM2S_DRE", mm2s_dre},  {"MM2S_DATA_WIDTH", mm2s_width},
                        {"INCLUDE_S2MM", s2mm},          {"INCLUDE_S2MM_DRE", s2mm_dre},
                        {"S2MM_DATA_WIDTH", s2mm_width}, {"NUM_MM2S_CHANNELS", 1},
                        {"NUM_S2MM_CHANNELS", 1},        {"MM2S_BURST_SIZE", reads},
                        {"S2MM_BURST_SIZE", writes},     {"MICRO_DMA", 0},
                        {"ADDRWIDTH", address_width},    {"SG_LENGTH_WIDTH", length_width}};
  if (sg != 0) device.sdt_options.emplace_back("INCLUDE_SG", sg);
}

void add_gpio(Device& device, const xilinx::AxiGpio& gpio) {
  device.driver = "GPIO";
  device.compatible = "xlnx,axi-gpio-2.0";
  device.options = {{"IS_DUAL", gpio.is_dual.get()},
                    {"INTERRUPT_PRESENT", gpio.interrupt_present.get()}};
  device.sdt_options = device.options;
  device.sdt_options.emplace_back("GPIO_WIDTH", gpio.gpio.width);
}

void add_intc(Device& device, const xilinx::AxiIntc& intc) {
  constexpr std::uint32_t no_address = 0;
  device.driver = "INTC";
  device.compatible = "xlnx,axi-intc-4.1";
  device.options = {{"KIND_OF_INTR", intc.kind_of_intr},
                    {"HAS_FAST", 0},
                    {"IVAR_RESET_VALUE", no_address},
                    {"NUM_INTR_INPUTS", intc.num_intr_inputs},
                    {"NUM_SW_INTR", 0},
                    {"ADDR_WIDTH", 32},
                    {"INTC_TYPE", 0}};
  device.sdt_options = {{"KIND_OF_INTR", intc.kind_of_intr},
                        {"NUM_INTR_INPUTS", intc.num_intr_inputs},
                        {"NUM_SW_INTR", 0}};
}

void add_quad_spi(Device& device, const xilinx::AxiQuadSpi& spi) {
  device.driver = "SPI";
  device.compatible = "xlnx,axi-quad-spi-3.2";
  device.options = {{"FIFO_EXIST", 1},
                    {"FIFO_DEPTH", spi.fifo_depth},
                    {"SPI_SLAVE_ONLY", 0},
                    {"NUM_SS_BITS", spi.num_ss_bits},
                    {"NUM_TRANSFER_BITS", spi.num_transfer_bits},
                    {"SPI_MODE", 0},
                    {"TYPE_OF_AXI4_INTERFACE", 0},
                    {"AXI4_BASEADDR", 0},
                    {"AXI4_HIGHADDR", 0},
                    {"XIP_MODE", 0},
                    {"USE_STARTUP", 0}};
  device.sdt_options = {{"FIFO_EXIST", 1},
                        {"FIFO_SIZE", spi.fifo_depth},
                        {"NUM_SS_BITS", spi.num_ss_bits},
                        {"NUM_TRANSFER_BITS", spi.num_transfer_bits},
                        {"SPI_MODE", 0}};
}

void add_uartlite(Device& device, const xilinx::AxiUartlite& uart) {
  device.driver = "UARTLITE";
  device.compatible = "xlnx,axi-uartlite-2.0";
  device.options = {{"BAUDRATE", uart.baudrate},
                    {"USE_PARITY", uart.use_parity.get()},
                    {"ODD_PARITY", 0},
                    {"DATA_BITS", uart.data_bits}};
  device.sdt_options = device.options;
}

/// What a channel is built with; one that is not built has the defaults of its options.
xilinx::VdmaChannelBuild build_of(const xilinx::VdmaChannel* channel) {
  xilinx::VdmaChannelBuild build;
  build.include = channel != nullptr;
  if (!channel) return build;
  build.genlock = channel->genlock();
  build.dre = channel->has_dre();
  build.memory_bytes = channel->memory_bytes;
  build.stream_bytes = channel->stream_bytes;
  build.line_buffer = channel->line_buffer;
  return build;
}

/// The debug registers are those of Vivado's usual build: counters of frames and delays.
void add_vdma(Device& device, const xilinx::AxiVdma& vdma) {
  constexpr std::uint32_t address_width = 32, follows_streams = 1;
  const xilinx::VdmaChannelBuild mm2s = build_of(vdma.mm2s()), s2mm = build_of(vdma.s2mm());
  const auto number = [](xilinx::GenlockMode mode) { return static_cast<std::uint32_t>(mode); };
  device.driver = "AXIVDMA";
  device.compatible = "xlnx,axi-vdma-6.3";
  device.options = {{"NUM_FSTORES", vdma.frame_stores},
                    {"INCLUDE_MM2S", mm2s.include},
                    {"INCLUDE_MM2S_DRE", mm2s.dre},
                    {"M_AXI_MM2S_DATA_WIDTH", 8 * mm2s.memory_bytes},
                    {"INCLUDE_S2MM", s2mm.include},
                    {"INCLUDE_S2MM_DRE", s2mm.dre},
                    {"M_AXI_S2MM_DATA_WIDTH", 8 * s2mm.memory_bytes},
                    {"AXI_MM2S_ACLK_FREQ_HZ", 0},
                    {"AXI_S2MM_ACLK_FREQ_HZ", 0},
                    {"MM2S_GENLOCK_MODE", number(mm2s.genlock)},
                    {"MM2S_GENLOCK_NUM_MASTERS", 1},
                    {"S2MM_GENLOCK_MODE", number(s2mm.genlock)},
                    {"S2MM_GENLOCK_NUM_MASTERS", 1},
                    {"INCLUDE_SG", 0},
                    {"ENABLE_VIDPRMTR_READS", 1},
                    {"USE_FSYNC", follows_streams},
                    {"FLUSH_ON_FSYNC", 1},
                    {"MM2S_LINEBUFFER_DEPTH", mm2s.line_buffer},
                    {"S2MM_LINEBUFFER_DEPTH", s2mm.line_buffer},
                    {"INCLUDE_INTERNAL_GENLOCK", vdma.has_internal_genlock()},
                    {"S2MM_SOF_ENABLE", 1},
                    {"M_AXIS_MM2S_TDATA_WIDTH", 8 * mm2s.stream_bytes},
                    {"S_AXIS_S2MM_TDATA_WIDTH", 8 * s2mm.stream_bytes},
                    {"ENABLE_DEBUG_INFO_1", 0},
                    {"ENABLE_DEBUG_INFO_5", 0},
                    {"ENABLE_DEBUG_INFO_6", 1},
                    {"ENABLE_DEBUG_INFO_7", 1},
                    {"ENABLE_DEBUG_INFO_9", 0},
                    {"ENABLE_DEBUG_INFO_13", 0},
                    {"ENABLE_DEBUG_INFO_14", 1},
                    {"ENABLE_DEBUG_INFO_15", 1},
                    {"ENABLE_DEBUG_ALL", 0},
                    {"ADDR_WIDTH", address_width},
                    {"c_addr_width", address_width},
                    {"c_enable_vert_flip", 0}};
  device.sdt_options = {{"NUM_FSTORES", vdma.frame_stores},
                        {"INCLUDE_MM2S", mm2s.include},
                        {"INCLUDE_MM2S_DRE", mm2s.dre},
                        {"MM2S_DATA_WIDTH", 8 * mm2s.memory_bytes},
                        {"INCLUDE_S2MM", s2mm.include},
                        {"INCLUDE_S2MM_DRE", s2mm.dre},
                        {"S2MM_DATA_WIDTH", 8 * s2mm.memory_bytes},
                        {"INCLUDE_SG", 0},
                        {"ENABLE_VIDPARAM_READS", 1},
                        {"FLUSH_FSYNC", follows_streams},
                        {"FLUSH_ON_FSYNC", 1},
                        {"MM2S_LINEBUFFER_DEPTH", mm2s.line_buffer},
                        {"S2MM_LINEBUFFER_DEPTH", s2mm.line_buffer},
                        {"MM2S_GENLOCK_MODE", number(mm2s.genlock)},
                        {"S2MM_GENLOCK_MODE", number(s2mm.genlock)},
                        {"INCLUDE_INTERNAL_GENLOCK", vdma.has_internal_genlock()},
                        {"S2MM_SOF_ENABLE", 1},
                        {"MM2S_TDATA_WIDTH", 8 * mm2s.stream_bytes},
                        {"S2MM_TDATA_WIDTH", 8 * s2mm.stream_bytes},
                        {"ADDRWIDTH", address_width}};
}

void add_bram(Device& device) {
  constexpr std::uint32_t width = 32;
  device.driver = "BRAM";
  device.compatible = "xlnx,axi-bram-ctrl-4.1";
  device.options = {{"DATA_WIDTH", width},
                    {"ECC", 0},
                    {"FAULT_INJECT", 0},
                    {"CE_FAILING_REGISTERS", 0},
                    {"UE_FAILING_REGISTERS", 0},
                    {"ECC_STATUS_REGISTERS", 0},
                    {"CE_COUNTER_WIDTH", 0},
                    {"ECC_ONOFF_REGISTER", 0},
                    {"ECC_ONOFF_RESET_VALUE", 0},
                    {"WRITE_ACCESS", 0},
                    {"S_AXI_BASEADDR", device.base},
                    {"S_AXI_HIGHADDR", device.last}};
}

/// A stub of the vendor's IP has its driver's number, as on the chip; what it was built with is
/// unknown here.
void add_stub(Device& device, const std::string& vlnv) {
  static const std::pair<const char*, const char*> drivers[] = {{"axi_dma", "AXIDMA"},
                                                                {"axi_vdma", "AXIVDMA"},
                                                                {"axi_cdma", "AXICDMA"},
                                                                {"axi_gpio", "GPIO"},
                                                                {"axi_timer", "TMRCTR"},
                                                                {"axi_intc", "INTC"},
                                                                {"axi_iic", "IIC"},
                                                                {"axi_quad_spi", "SPI"},
                                                                {"axi_uartlite", "UARTLITE"},
                                                                {"axi_fifo_mm_s", "AXI_FIFO"},
                                                                {"xadc_wiz", "SYSMON"},
                                                                {"clk_wiz", "CLK_WIZ"},
                                                                {"axi_ethernetlite", "EMACLITE"},
                                                                {"v_tc", "VTC"},
                                                                {"axi_uart16550", "UARTNS550"}};
  const std::vector<std::string> words = vp::split(vlnv, ':');
  if (words.size() != 4 || words[0] != "xilinx.com" || words[1] != "ip") return;
  for (const auto& [ip, driver] : drivers) {
    if (words[2] == ip) device.driver = driver;
  }
}

}  // namespace

void add_build(Device& device, const sc_core::sc_object& module) {
  if (const auto* dma = dynamic_cast<const xilinx::AxiDma*>(&module)) {
    add_dma(device, *dma);
  } else if (const auto* gpio = dynamic_cast<const xilinx::AxiGpio*>(&module)) {
    add_gpio(device, *gpio);
  } else if (const auto* timer = dynamic_cast<const xilinx::AxiTimer*>(&module)) {
    device.driver = "TMRCTR";
    device.compatible = "xlnx,axi-timer-2.0";
    device.options = {{"CLOCK_FREQ_HZ", hz(*timer)}};
    device.sdt_options = {{"CLOCK_FREQUENCY", hz(*timer)}};
  } else if (const auto* intc = dynamic_cast<const xilinx::AxiIntc*>(&module)) {
    add_intc(device, *intc);
  } else if (const auto* iic = dynamic_cast<const xilinx::AxiIic*>(&module)) {
    device.driver = "IIC";
    device.compatible = "xlnx,axi-iic-2.1";
    device.options = {{"TEN_BIT_ADR", 0}, {"GPO_WIDTH", iic->gpo_width}};
    device.sdt_options = {{"IIC_FREQ", iic->iic_freq}, {"GPO_WIDTH", iic->gpo_width}};
  } else if (const auto* spi = dynamic_cast<const xilinx::AxiQuadSpi*>(&module)) {
    add_quad_spi(device, *spi);
  } else if (const auto* uart = dynamic_cast<const xilinx::AxiUartlite*>(&module)) {
    add_uartlite(device, *uart);
  } else if (dynamic_cast<const xilinx::AxiFifoMmS*>(&module)) {
    device.driver = "AXI_FIFO";
    device.compatible = "xlnx,axi-fifo-mm-s-4.2";
    device.options = {{"AXI4_BASEADDR", 0}, {"AXI4_HIGHADDR", 0}, {"DATA_INTERFACE_TYPE", 0}};
    device.sdt_options = {{"DATA_INTERFACE_TYPE", 0}};
  } else if (const auto* cdma = dynamic_cast<const xilinx::AxiCdma*>(&module)) {
    device.driver = "AXICDMA";
    device.compatible = "xlnx,axi-cdma-4.1";
    const std::uint32_t width = 8 * cdma->memory_bytes;
    device.options = {{"INCLUDE_DRE", 0},          {"USE_DATAMOVER_LITE", 0},
                      {"M_AXI_DATA_WIDTH", width}, {"M_AXI_MAX_BURST_LEN", cdma->burst_beats},
                      {"ADDR_WIDTH", 32},          {"INCLUDE_SG", 0}};
    device.sdt_options = {
        {"DATA_WIDTH", width}, {"MAX_BURST_LEN", cdma->burst_beats}, {"ADDRWIDTH", 32}};
  } else if (const auto* vdma = dynamic_cast<const xilinx::AxiVdma*>(&module)) {
    add_vdma(device, *vdma);
  } else if (dynamic_cast<const xilinx::XadcWiz*>(&module)) {
    device.driver = "SYSMON";
    device.compatible = "xlnx,xadc-wiz-3.3";
    device.options = {{"INCLUDE_INTR", 1}, {"IP_TYPE", 0}};
  } else if (dynamic_cast<const xilinx::ClkWiz*>(&module)) {
    device.driver = "CLK_WIZ";
    device.compatible = "xlnx,clocking-wizard";
  } else if (dynamic_cast<const xilinx::VTc*>(&module)) {
    device.driver = "VTC";
    device.compatible = "xlnx,v-tc-6.2";
  } else if (dynamic_cast<const xilinx::AxiBramCtrl*>(&module)) {
    add_bram(device);
  } else if (const auto* stub = dynamic_cast<const xilinx::RegisterStub*>(&module)) {
    add_stub(device, stub->ip());
  }
}

}  // namespace xparameters
