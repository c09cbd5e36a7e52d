// The small IP of the shelf as parts of a design: parameters, interrupts through controllers,
// clocks, and what is refused.
#include <chip/system/hardware_map.h>
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
#include <xilinx/clk_wiz/clk_wiz.h>
#include <xilinx/xadc_wiz/xadc_wiz.h>
#include <boost/test/unit_test.hpp>

#include <string>

#include "built_design.h"
#include "input_error.h"

using kit::BuiltDesign;
using kit::replaced;

namespace {

constexpr const char* clocked = "s_axi_aclk: ps.FCLK_CLK0, s_axi_aresetn: rst.peripheral_aresetn";

std::string part(const std::string& name, const std::string& ip, const std::string& parameters,
                 const std::string& pins, const std::string& buses) {
  return "  " + name + ":\n    ip: xilinx.com:ip:" + ip + "\n    parameters: {" + parameters +
         "}\n    pins: {" + pins + "}\n    buses: {" + buses + "}\n";
}

/// One of each; the timer's interrupt passes two controllers, the IIC's one.
std::string shelf_design() {
  const std::string on = clocked;
  return "name: shelf\nsettings: {device: xc7z020-1, ps.fclk_clk0.frequency: 100 MHz}\nparts:\n" +
         part("ps", "processing_system7:5.5", "",
              "M_AXI_GP0_ACLK: ps.FCLK_CLK0, IRQ_F2P: outer.irq", "S_AXI_HP0: axi_cdma_0.M_AXI") +
         part("rst", "proc_sys_reset:5.0", "",
              "slowest_sync_clk: ps.FCLK_CLK0, ext_reset_in: ps.FCLK_RESET0_N", "") +
         part("bus", "axi_interconnect:2.1", "", "ACLK: ps.FCLK_CLK0", "S00_AXI: ps.M_AXI_GP0") +
         part("axi_timer_0", "axi_timer:2.0", "", on, "S_AXI: bus.M00_AXI") +
         part("slow", "axi_timer:2.0", "C_COUNT_WIDTH: 16, C_ONE_TIMER_ONLY: 1, C_GEN0_ASSERT: 0",
              "s_axi_aclk: clk_wiz_0.pixel", "S_AXI: bus.M01_AXI") +
         part("inner", "axi_intc:4.1", "C_NUM_INTR_INPUTS: 2, C_KIND_OF_INTR: 0, C_KIND_OF_LVL: 1",
              on + ", intr: of_inner.dout", "s_axi: bus.M02_AXI") +
         part("of_inner", "xlconcat:2.1", "NUM_PORTS: 2",
              "In0: axi_timer_0.interrupt, In1: slow.generateout0", "") +
         part("outer", "axi_intc:4.1", "C_NUM_INTR_INPUTS: 2, C_KIND_OF_INTR: 0",
              on + ", intr: of_outer.dout", "s_axi: bus.M03_AXI") +
         part("of_outer", "xlconcat:2.1", "NUM_PORTS: 2",
              "In0: inner.irq, In1: axi_iic_0.iic2intc_irpt", "") +
         part("axi_iic_0", "axi_iic:2.1",
              "C_IIC_FREQ: 400000, C_GPO_WIDTH: 3, C_DEFAULT_VALUE: '0x05'", on,
              "S_AXI: bus.M04_AXI") +
         part("axi_uartlite_0", "axi_uartlite:2.0", "C_BAUDRATE: 115200, C_USE_PARITY: 1", on,
              "S_AXI: bus.M05_AXI") +
         part("axi_quad_spi_0", "axi_quad_spi:3.2", "C_NUM_SS_BITS: 2",
              on + ", ext_spi_clk: clk_wiz_0.pixel", "AXI_LITE: bus.M06_AXI") +
         part("fifo", "axi_fifo_mm_s:4.2", "C_TX_FIFO_DEPTH: 1024", on,
              "S_AXI: bus.M07_AXI, AXI_STR_RXD: fifo.AXI_STR_TXD") +
         part("axi_cdma_0", "axi_cdma:4.1", "C_M_AXI_DATA_WIDTH: 64",
              "m_axi_aclk: ps.FCLK_CLK0, s_axi_lite_aclk: ps.FCLK_CLK0",
              "S_AXI_LITE: bus.M08_AXI") +
         part("xadc_wiz_0", "xadc_wiz:3.3",
              "SEQUENCER_MODE: Continuous, C_SEQUENCE_R0: 256, C_SEQUENCE_R1: 49152, "
              "C_CONFIGURATION_R2: 1280, C_ALARM_LIMIT_R0: 46573",
              on, "s_axi_lite: bus.M09_AXI") +
         part("clk_wiz_0", "clk_wiz:6.0",
              "USE_DYN_RECONFIG: 'true', CLK_OUT1_PORT: pixel, MMCM_CLKOUT0_DIVIDE_F: 20.000",
              on + ", clk_in1: ps.FCLK_CLK0", "s_axi_lite: bus.M10_AXI") +
         "addresses:\n  ps.M_AXI_GP0:\n"
         "    axi_timer_0.S_AXI: [0x42800000, 64 KiB]\n    slow.S_AXI: [0x42810000, 64 KiB]\n"
         "    inner.s_axi: [0x41800000, 64 KiB]\n    outer.s_axi: [0x41810000, 64 KiB]\n"
         "    axi_iic_0.S_AXI: [0x41600000, 64 KiB]\n"
         "    axi_uartlite_0.S_AXI: [0x42C00000, 64 KiB]\n"
         "    axi_quad_spi_0.AXI_LITE: [0x41E00000, 64 KiB]\n"
         "    fifo.S_AXI: [0x43C00000, 64 KiB]\n"
         "    axi_cdma_0.S_AXI_LITE: [0x7E200000, 64 KiB]\n"
         "    xadc_wiz_0.s_axi_lite: [0x43C10000, 64 KiB]\n"
         "    clk_wiz_0.s_axi_lite: [0x43C20000, 64 KiB]\n"
         "  axi_cdma_0.M_AXI:\n    ps.S_AXI_HP0: [0x0, 512 MiB]\n";
}

std::string refusal(const std::string& what, const std::string& by) {
  return input_error([&] { const BuiltDesign chip(replaced(shelf_design(), what, by)); });
}

bool has(const std::string& text, const std::string& what) {
  return text.find(what) != std::string::npos;
}

}  // namespace

BOOST_AUTO_TEST_SUITE(parts_of_the_shelf)

BOOST_AUTO_TEST_CASE(each_is_built_as_its_parameters_say) {
  BuiltDesign chip(shelf_design());
  auto& slow = chip.part<xilinx::AxiTimer>("slow");
  BOOST_TEST(slow.count_width.get() == 16u);
  BOOST_TEST(slow.one_timer_only.get());
  BOOST_TEST(slow.clock().frequency_hz() == 50'000'000u);
  auto& iic = chip.part<xilinx::AxiIic>("axi_iic_0");
  BOOST_TEST(iic.iic_freq.get() == 400'000u);
  BOOST_TEST(iic.gpo.get() == 5u);
  BOOST_TEST(chip.part<xilinx::AxiUartlite>("axi_uartlite_0").use_parity.get());
  BOOST_TEST(chip.part<xilinx::AxiQuadSpi>("axi_quad_spi_0").num_ss_bits.get() == 2u);
  auto& fifo = chip.part<xilinx::AxiFifoMmS>("fifo");
  BOOST_TEST(BuiltDesign::read(fifo.s_axi, axi_fifo_mm_s::TDFV) == 1020u);
  BOOST_TEST(chip.part<xilinx::AxiCdma>("axi_cdma_0").memory_bytes.get() == 8u);
  auto& xadc = chip.part<xilinx::XadcWiz>("xadc_wiz_0");
  BOOST_TEST(xadc.sequence_channels.get() == 3u);
  BOOST_TEST(xadc.adcclk_divisor.get() == 5u);
  BOOST_TEST(xadc.converter.read(0x50) == 46573u);
}

// Vivado sets the lengths of bursts by channel, and may lead both channels out as one master.
BOOST_AUTO_TEST_CASE(both_channels_of_a_dma_leave_as_one_master) {
  const std::string dma =
      part("axi_dma_0", "axi_dma:7.1",
           "C_INCLUDE_SG: 0, C_SINGLE_INTERFACE: 1, C_MM2S_BURST_SIZE: 8, C_S2MM_BURST_SIZE: 64",
           "s_axi_lite_aclk: ps.FCLK_CLK0",
           "S_AXI_LITE: bus.M11_AXI, S_AXIS_S2MM: axi_dma_0.M_AXIS_MM2S");
  std::string text = replaced(shelf_design(), "addresses:\n  ps.M_AXI_GP0:\n",
                              dma +
                                  "addresses:\n  axi_dma_0.M_AXI:\n"
                                  "    ps.S_AXI_HP1: [0x0, 512 MiB]\n  ps.M_AXI_GP0:\n"
                                  "    axi_dma_0.S_AXI_LITE: [0x40400000, 64 KiB]\n");
  text = replaced(text, "S_AXI_HP0: axi_cdma_0.M_AXI",
                  "S_AXI_HP0: axi_cdma_0.M_AXI, S_AXI_HP1: axi_dma_0.M_AXI");
  BuiltDesign chip(text);
  auto& engine = chip.part<xilinx::AxiDma>("axi_dma_0");
  BOOST_TEST(engine.mm2s_burst_beats.get() == 8u);
  BOOST_TEST(engine.s2mm_burst_beats.get() == 64u);
  constexpr std::uint32_t from = 0x1000'0000, to = 0x1000'1000, bytes = 64;
  chip.zynq->ps.ddr.at(from, bytes)[5] = 0x5A;
  using namespace axi_dma;
  for (const std::uint32_t control : {S2MM_DMACR, MM2S_DMACR})
    BuiltDesign::write(engine.s_axi_lite, control, dmacr::RS);
  BuiltDesign::write(engine.s_axi_lite, S2MM_DA, to);
  BuiltDesign::write(engine.s_axi_lite, S2MM_LENGTH, bytes);
  BuiltDesign::write(engine.s_axi_lite, MM2S_SA, from);
  BuiltDesign::write(engine.s_axi_lite, MM2S_LENGTH, bytes);
  BuiltDesign::pass_us(10);
  BOOST_TEST(unsigned{chip.zynq->ps.ddr.at(to, bytes)[5]} == 0x5Au);
}

// The address editor lets a slave be without one, and a master without all of them.
BOOST_AUTO_TEST_CASE(a_slave_without_an_address_is_out_of_reach) {
  const std::string unseen =
      part("mem", "smartconnect:1.0", "", "aclk: ps.FCLK_CLK0", "S00_AXI: axi_cdma_0.M_AXI");
  std::string text = replaced(shelf_design(), "addresses:\n", unseen + "addresses:\n");
  text = replaced(text, "S_AXI_HP0: axi_cdma_0.M_AXI", "S_AXI_HP0: mem.M00_AXI");
  text = replaced(text, "  axi_cdma_0.M_AXI:\n    ps.S_AXI_HP0: [0x0, 512 MiB]\n", "");
  BuiltDesign chip(replaced(text, "    axi_iic_0.S_AXI: [0x41600000, 64 KiB]\n", ""));
  BuiltDesign::pass_us(1);
  BOOST_TEST(chip.part<xilinx::AxiIic>("axi_iic_0").gpo.get() == 5u);
  for (const auto& device : platform::hardware_map(*chip.zynq).devices)
    BOOST_TEST(device.name != "axi_iic_0");
}

BOOST_AUTO_TEST_CASE(an_interrupt_passes_two_controllers) {
  BuiltDesign chip(shelf_design());
  using namespace axi_intc;
  for (const char* name : {"inner", "outer"}) {
    auto& intc = chip.part<xilinx::AxiIntc>(name);
    BuiltDesign::write(intc.s_axi, IER, 3);
    BuiltDesign::write(intc.s_axi, MER, mer::ME | mer::HIE);
  }
  BuiltDesign::pass_us(1);
  auto& inner = chip.part<xilinx::AxiIntc>("inner");
  // Input 1 is active low, and the output of the timer is, too: it rests.
  BOOST_TEST(BuiltDesign::read(inner.s_axi, IPR) == 0u);
  BOOST_TEST(!chip.zynq->ps.gic.logic().wire[61]);
  chip.part<xilinx::AxiTimer>("axi_timer_0").interrupt = true;
  BuiltDesign::pass_us(1);
  BOOST_TEST(BuiltDesign::read(inner.s_axi, IVR) == 0u);
  BOOST_TEST(BuiltDesign::read(chip.part<xilinx::AxiIntc>("outer").s_axi, IVR) == 0u);
  BOOST_TEST(chip.zynq->ps.gic.logic().wire[61]);
}

BOOST_AUTO_TEST_CASE(programs_find_the_numbers_at_each_controller) {
  BuiltDesign chip(shelf_design());
  const std::string header = platform::xparameters_header(*chip.zynq);
  for (const char* line :
       {"#define XPAR_INNER_AXI_TIMER_0_INTERRUPT_INTR 0\n", "#define XPAR_INTC_0_TMRCTR_0_VEC_ID",
        "#define XPAR_OUTER_INNER_IRQ_INTR 0\n",
        "#define XPAR_OUTER_AXI_IIC_0_IIC2INTC_IRPT_INTR 1\n",
        "#define XPAR_AXI_IIC_0_IIC2INTC_IRPT_MASK 0x00000002U\n",
        "#define XPAR_INTC_MAX_NUM_INTR_INPUTS 2\n", "#define XPAR_XIIC_0_INTERRUPTS 0x1\n",
        "#define XPAR_XIIC_0_INTERRUPT_PARENT 0x41810001U\n",
        "#define XPAR_FABRIC_OUTER_IRQ_INTR 61\n"})
    BOOST_TEST(has(header, line), line);
}

BOOST_AUTO_TEST_CASE(software_changes_the_clock_of_other_parts) {
  using namespace clk_wiz;
  BuiltDesign chip(shelf_design());
  BuiltDesign::pass_us(1);
  auto& wizard = chip.part<xilinx::ClkWiz>("clk_wiz_0");
  BuiltDesign::write(wizard.s_axi_lite, CCR2, 8);
  BuiltDesign::write(wizard.s_axi_lite, CCR23, ccr23::LOAD | ccr23::SADDR);
  BuiltDesign::pass_us(200);
  BOOST_TEST(chip.part<xilinx::AxiTimer>("slow").clock().frequency_hz() == 125'000'000u);
}

BOOST_AUTO_TEST_CASE(a_serial_line_leads_from_one_uart_to_another) {
  using namespace axi_uartlite;
  const std::string on = clocked;
  const auto second = [&](const std::string& baud, const std::string& odd = "0") {
    return part("second", "axi_uartlite:2.0",
                "C_BAUDRATE: " + baud + ", C_USE_PARITY: 1, C_ODD_PARITY: " + odd,
                on + ", rx: axi_uartlite_0.tx", "S_AXI: bus.M11_AXI") +
           "addresses:\n  ps.M_AXI_GP0:\n    second.S_AXI: [0x42C10000, 64 KiB]\n";
  };
  const std::string start = "addresses:\n  ps.M_AXI_GP0:\n";
  for (const std::string& other : {second("9600"), second("115200", "1")}) {
    const std::string refused = refusal(start, other);
    BOOST_TEST(has(refused, "other baud rates or formats"), refused);
  }
  BuiltDesign chip(replaced(shelf_design(), start, second("115200")));
  auto& first = chip.part<xilinx::AxiUartlite>("axi_uartlite_0");
  auto& other = chip.part<xilinx::AxiUartlite>("second");
  BuiltDesign::pass_us(1);
  BuiltDesign::write(first.s_axi, TX_FIFO, 'a');
  BuiltDesign::pass_us(90);  // 11 bits at 115 200 baud take 95 us
  BOOST_TEST((BuiltDesign::read(other.s_axi, STAT_REG) & stat::Rx_FIFO_Valid_Data) == 0u);
  BuiltDesign::pass_us(10);
  BOOST_TEST(BuiltDesign::read(other.s_axi, RX_FIFO) == 'a');
  BOOST_TEST((BuiltDesign::read(first.s_axi, STAT_REG) & stat::Rx_FIFO_Valid_Data) == 0u);
}

BOOST_AUTO_TEST_CASE(an_alarm_of_the_converter_is_a_wire) {
  std::string design = replaced(shelf_design(), "In1: axi_iic_0.iic2intc_irpt",
                                "In1: xadc_wiz_0.user_temp_alarm_out");
  design = replaced(design, "C_ALARM_LIMIT_R0: 46573",
                    "C_ALARM_LIMIT_R0: 46573, C_CONFIGURATION_R1: 8192");
  BuiltDesign chip(design);
  auto& xadc = chip.part<xilinx::XadcWiz>("xadc_wiz_0");
  auto& outer = chip.part<xilinx::AxiIntc>("outer");
  BuiltDesign::pass_us(1);
  BuiltDesign::write(outer.s_axi, axi_intc::MER, axi_intc::mer::ME | axi_intc::mer::HIE);
  BOOST_TEST((BuiltDesign::read(outer.s_axi, axi_intc::ISR) & 2) == 0u);
  xadc.set_input(board::Xadc::temperature, 120);  // above 85, the limit
  BuiltDesign::pass_us(1);
  BOOST_TEST((BuiltDesign::read(outer.s_axi, axi_intc::ISR) & 2) == 2u);
}

BOOST_AUTO_TEST_CASE(what_is_not_modelled_is_refused_by_name) {
  BOOST_TEST(has(refusal("C_M_AXI_DATA_WIDTH: 64", "C_INCLUDE_SG: 1"),
                 "axi_cdma_0: C_INCLUDE_SG = 1 is not modelled, but 0"));
  BOOST_TEST(has(refusal("C_IIC_FREQ: 400000", "C_IIC_FREQ: 4000000"),
                 "C_IIC_FREQ = 4000000 is not modelled, but 1000 to 1000000"));
  BOOST_TEST(has(refusal("C_NUM_SS_BITS: 2", "C_SPI_MODE: 2"), "C_SPI_MODE = 2 is not modelled"));
  BOOST_TEST(has(refusal("C_NUM_INTR_INPUTS: 2, C_KIND_OF_INTR: 0}", "C_HAS_FAST: 1}"),
                 "outer: C_HAS_FAST = 1 is not modelled"));
  BOOST_TEST(
      has(refusal("C_BAUDRATE: 115200", "C_BAUD_RATE: 115200"),
          "axi_uartlite has no parameter 'C_BAUD_RATE' that matters: did you mean 'C_BAUDRATE'"));
  BOOST_TEST(has(refusal("MMCM_CLKOUT0_DIVIDE_F: 20.000", "MMCM_CLKFBOUT_MULT_F: 20.000"),
                 "clk_wiz_0: its VCO would run at 2000 MHz; choose factors that give 600 to 1200"));
  // The line of a serial port to another part has no levels here.
  const std::string line = refusal(
      "pins: {s_axi_aclk: ps.FCLK_CLK0, s_axi_aresetn: rst.peripheral_aresetn}\n    buses: "
      "{S_AXI: bus.M05_AXI}",
      "pins: {s_axi_aclk: ps.FCLK_CLK0, rx: axi_timer_0.pwm0}\n    buses: {S_AXI: bus.M05_AXI}");
  BOOST_TEST(has(line, "its pin rx is driven by axi_timer_0.pwm0"), line);
}

namespace {

/// A memory that software sees through a controller at port A, and a GPIO at port B.
std::string memory_design() {
  const std::string on = clocked;
  return "name: shared\nsettings: {device: xc7z020-1, ps.fclk_clk0.frequency: 100 MHz}\nparts:\n" +
         part("ps", "processing_system7:5.5", "", "M_AXI_GP0_ACLK: ps.FCLK_CLK0", "") +
         part("rst", "proc_sys_reset:5.0", "",
              "slowest_sync_clk: ps.FCLK_CLK0, ext_reset_in: ps.FCLK_RESET0_N", "") +
         part("bus", "axi_interconnect:2.1", "", "ACLK: ps.FCLK_CLK0", "S00_AXI: ps.M_AXI_GP0") +
         part("control", "axi_bram_ctrl:4.1", "", on, "S_AXI: bus.M00_AXI") +
         part("gpio", "axi_gpio:2.0", "C_IS_DUAL: 1, C_ALL_OUTPUTS: 1, C_ALL_INPUTS_2: 1",
              on + ", gpio2_io_i: memory.doutb", "S_AXI: bus.M01_AXI") +
         part("memory", "blk_mem_gen:8.4",
              "C_MEM_TYPE: 2, C_USE_BRAM_BLOCK: 1, C_BYTE_SIZE: 8, C_WRITE_WIDTH_A: 32, "
              "C_READ_WIDTH_A: 32, C_WRITE_WIDTH_B: 32, C_READ_WIDTH_B: 32, C_USE_BYTE_WEB: 1, "
              "C_COUNT_36K_BRAM: 2",
              "clka: control.bram_clk_a, addra: control.bram_addr_a, wea: control.bram_we_a, "
              "clkb: ps.FCLK_CLK0, addrb: gpio.gpio_io_o",
              "") +
         "addresses:\n  ps.M_AXI_GP0:\n    control.S_AXI: [0x40000000, 8 KiB]\n"
         "    gpio.S_AXI: [0x41200000, 64 KiB]\n";
}

}  // namespace

BOOST_AUTO_TEST_CASE(logic_reads_block_memory_that_software_writes) {
  BuiltDesign chip(memory_design());
  BOOST_TEST(dynamic_cast<platform::block_design::BlockDesign&>(*sc_core::sc_find_object("pl"))
                 .used_stubs()
                 .empty());
  auto& control = chip.part<xilinx::AxiBramCtrl>("control");
  auto& gpio = chip.part<xilinx::AxiGpio>("gpio");
  control.contents()[0x104] = 0x5A;
  BuiltDesign::pass_us(10);
  BuiltDesign::write(gpio.s_axi, 0, 0x104);
  BuiltDesign::pass_us(2000);  // clocks run up to 1 ms ahead of a test that is no process
  BOOST_TEST(BuiltDesign::read(gpio.s_axi, 8) == 0x5Au);
}

BOOST_AUTO_TEST_CASE(block_memory_that_does_not_fit_is_refused) {
  const auto refused = [](const std::string& what, const std::string& by) {
    return input_error([&] { const BuiltDesign chip(replaced(memory_design(), what, by)); });
  };
  BOOST_TEST(has(refused("C_READ_WIDTH_B: 32", "C_READ_WIDTH_B: 16"),
                 "memory: its port B reads other widths than it writes"));
  BOOST_TEST(has(refused("C_COUNT_36K_BRAM: 2", "C_LOAD_INIT_FILE: 1, Coe_File: absent.coe"),
                 "absent.coe"));
  BOOST_TEST(has(refused("clkb: ps.FCLK_CLK0", "clkb: gpio.gpio_io_t"), "memory") == false,
             "the clock of what drives it");
}

BOOST_AUTO_TEST_SUITE_END()
