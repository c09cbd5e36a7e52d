#pragma once

#include <slcr_fields.h>
#include <vp/register_description.h>

#include <cstdint>

/// System level control registers of the Zynq-7000 (UG585 chapters 25 and 26, appendix B.28):
/// clocks, resets, pins. What the platform models follows them; the others store what was written.
namespace slcr {

/// Bus address.
constexpr std::uint32_t base = 0xF8000000;
/// Bytes that the block decodes.
constexpr unsigned address_bits = 12;

constexpr std::uint32_t lock_key = 0x767B;
constexpr std::uint32_t unlock_key = 0xDF0D;

/// Offsets.
constexpr std::uint32_t SCL = 0x000;
constexpr std::uint32_t SLCR_LOCK = 0x004;
constexpr std::uint32_t SLCR_UNLOCK = 0x008;
constexpr std::uint32_t SLCR_LOCKSTA = 0x00C;
constexpr std::uint32_t ARM_PLL_CTRL = 0x100;
constexpr std::uint32_t DDR_PLL_CTRL = 0x104;
constexpr std::uint32_t IO_PLL_CTRL = 0x108;
constexpr std::uint32_t PLL_STATUS = 0x10C;
constexpr std::uint32_t ARM_PLL_CFG = 0x110;
constexpr std::uint32_t DDR_PLL_CFG = 0x114;
constexpr std::uint32_t IO_PLL_CFG = 0x118;
constexpr std::uint32_t ARM_CLK_CTRL = 0x120;
constexpr std::uint32_t DDR_CLK_CTRL = 0x124;
constexpr std::uint32_t DCI_CLK_CTRL = 0x128;
constexpr std::uint32_t APER_CLK_CTRL = 0x12C;
constexpr std::uint32_t USB0_CLK_CTRL = 0x130;
constexpr std::uint32_t USB1_CLK_CTRL = 0x134;
constexpr std::uint32_t GEM0_RCLK_CTRL = 0x138;
constexpr std::uint32_t GEM1_RCLK_CTRL = 0x13C;
constexpr std::uint32_t GEM0_CLK_CTRL = 0x140;
constexpr std::uint32_t GEM1_CLK_CTRL = 0x144;
constexpr std::uint32_t SMC_CLK_CTRL = 0x148;
constexpr std::uint32_t LQSPI_CLK_CTRL = 0x14C;
constexpr std::uint32_t SDIO_CLK_CTRL = 0x150;
constexpr std::uint32_t UART_CLK_CTRL = 0x154;
constexpr std::uint32_t SPI_CLK_CTRL = 0x158;
constexpr std::uint32_t CAN_CLK_CTRL = 0x15C;
constexpr std::uint32_t CAN_MIOCLK_CTRL = 0x160;
constexpr std::uint32_t DBG_CLK_CTRL = 0x164;
constexpr std::uint32_t PCAP_CLK_CTRL = 0x168;
constexpr std::uint32_t TOPSW_CLK_CTRL = 0x16C;
constexpr std::uint32_t FPGA0_CLK_CTRL = 0x170;
constexpr std::uint32_t FPGA0_THR_CTRL = 0x174;
constexpr std::uint32_t FPGA0_THR_CNT = 0x178;
constexpr std::uint32_t FPGA0_THR_STA = 0x17C;
constexpr std::uint32_t FPGA1_CLK_CTRL = 0x180;
constexpr std::uint32_t FPGA1_THR_CTRL = 0x184;
constexpr std::uint32_t FPGA1_THR_CNT = 0x188;
constexpr std::uint32_t FPGA1_THR_STA = 0x18C;
constexpr std::uint32_t FPGA2_CLK_CTRL = 0x190;
constexpr std::uint32_t FPGA2_THR_CTRL = 0x194;
constexpr std::uint32_t FPGA2_THR_CNT = 0x198;
constexpr std::uint32_t FPGA2_THR_STA = 0x19C;
constexpr std::uint32_t FPGA3_CLK_CTRL = 0x1A0;
constexpr std::uint32_t FPGA3_THR_CTRL = 0x1A4;
constexpr std::uint32_t FPGA3_THR_CNT = 0x1A8;
constexpr std::uint32_t FPGA3_THR_STA = 0x1AC;
constexpr std::uint32_t CLK_621_TRUE = 0x1C4;
constexpr std::uint32_t PSS_RST_CTRL = 0x200;
constexpr std::uint32_t DDR_RST_CTRL = 0x204;
constexpr std::uint32_t TOPSW_RST_CTRL = 0x208;
constexpr std::uint32_t DMAC_RST_CTRL = 0x20C;
constexpr std::uint32_t USB_RST_CTRL = 0x210;
constexpr std::uint32_t GEM_RST_CTRL = 0x214;
constexpr std::uint32_t SDIO_RST_CTRL = 0x218;
constexpr std::uint32_t SPI_RST_CTRL = 0x21C;
constexpr std::uint32_t CAN_RST_CTRL = 0x220;
constexpr std::uint32_t I2C_RST_CTRL = 0x224;
constexpr std::uint32_t UART_RST_CTRL = 0x228;
constexpr std::uint32_t GPIO_RST_CTRL = 0x22C;
constexpr std::uint32_t LQSPI_RST_CTRL = 0x230;
constexpr std::uint32_t SMC_RST_CTRL = 0x234;
constexpr std::uint32_t OCM_RST_CTRL = 0x238;
constexpr std::uint32_t FPGA_RST_CTRL = 0x240;
constexpr std::uint32_t A9_CPU_RST_CTRL = 0x244;
constexpr std::uint32_t RS_AWDT_CTRL = 0x24C;
constexpr std::uint32_t REBOOT_STATUS = 0x258;
constexpr std::uint32_t BOOT_MODE = 0x25C;
constexpr std::uint32_t APU_CTRL = 0x300;
constexpr std::uint32_t WDT_CLK_SEL = 0x304;
constexpr std::uint32_t TZ_DMA_NS = 0x440;
constexpr std::uint32_t TZ_DMA_IRQ_NS = 0x444;
constexpr std::uint32_t TZ_DMA_PERIPH_NS = 0x448;
constexpr std::uint32_t PSS_IDCODE = 0x530;
constexpr std::uint32_t DDR_URGENT = 0x600;
constexpr std::uint32_t DDR_CAL_START = 0x60C;
constexpr std::uint32_t DDR_REF_START = 0x614;
constexpr std::uint32_t DDR_CMD_STA = 0x618;
constexpr std::uint32_t DDR_URGENT_SEL = 0x61C;
constexpr std::uint32_t DDR_DFI_STATUS = 0x620;
/// Control of MIO pin 0 … 53.
constexpr std::uint32_t MIO_PIN(unsigned pin) {
  return 0x700 + 4 * pin;
}
constexpr unsigned mio_pins = 54;
namespace mio_pin {
constexpr std::uint32_t PULLUP = 1u << 12;
/// A bit a pin: all but 2 to 8, which choose how the chip boots (UG585, table 6-4).
constexpr std::uint64_t pull_ups_at_reset = 0x003F'FFFF'FFFF'FE03;
}  // namespace mio_pin
constexpr std::uint32_t MIO_LOOPBACK = 0x804;
constexpr std::uint32_t MIO_MST_TRI0 = 0x80C;
constexpr std::uint32_t MIO_MST_TRI1 = 0x810;
constexpr std::uint32_t SD0_WP_CD_SEL = 0x830;
constexpr std::uint32_t SD1_WP_CD_SEL = 0x834;
constexpr std::uint32_t LVL_SHFTR_EN = 0x900;
constexpr std::uint32_t OCM_CFG = 0x910;
constexpr std::uint32_t GPIOB_CTRL = 0xB00;
constexpr std::uint32_t GPIOB_CFG_CMOS18 = 0xB04;
constexpr std::uint32_t GPIOB_CFG_CMOS25 = 0xB08;
constexpr std::uint32_t GPIOB_CFG_CMOS33 = 0xB0C;
constexpr std::uint32_t GPIOB_CFG_HSTL = 0xB14;
constexpr std::uint32_t GPIOB_DRVR_BIAS_CTRL = 0xB18;
constexpr std::uint32_t DDRIOB_ADDR0 = 0xB40;
constexpr std::uint32_t DDRIOB_ADDR1 = 0xB44;
constexpr std::uint32_t DDRIOB_DATA0 = 0xB48;
constexpr std::uint32_t DDRIOB_DATA1 = 0xB4C;
constexpr std::uint32_t DDRIOB_DIFF0 = 0xB50;
constexpr std::uint32_t DDRIOB_DIFF1 = 0xB54;
constexpr std::uint32_t DDRIOB_CLOCK = 0xB58;
constexpr std::uint32_t DDRIOB_DRIVE_SLEW_ADDR = 0xB5C;
constexpr std::uint32_t DDRIOB_DRIVE_SLEW_DATA = 0xB60;
constexpr std::uint32_t DDRIOB_DRIVE_SLEW_DIFF = 0xB64;
constexpr std::uint32_t DDRIOB_DRIVE_SLEW_CLOCK = 0xB68;
constexpr std::uint32_t DDRIOB_DDR_CTRL = 0xB6C;
constexpr std::uint32_t DDRIOB_DCI_CTRL = 0xB70;
constexpr std::uint32_t DDRIOB_DCI_STATUS = 0xB74;

/// The registers of FCLK_CLKn: offset of those of clock 0 + n × fclk_stride.
constexpr unsigned fclk_count = 4;
constexpr std::uint32_t fclk_stride = 0x10;

/// Bits of ARM_PLL_CTRL, DDR_PLL_CTRL and IO_PLL_CTRL.
namespace pll_ctrl {
constexpr std::uint32_t PLL_RESET = 1u << 0;         ///< 1 holds the PLL in reset
constexpr std::uint32_t PLL_PWRDWN = 1u << 1;        ///< 1 powers it down
constexpr std::uint32_t PLL_BYPASS_QUAL = 1u << 3;   ///< bypass follows the strap pin, too
constexpr std::uint32_t PLL_BYPASS_FORCE = 1u << 4;  ///< 1: the output is PS_CLK
constexpr unsigned PLL_FDIV_shift = 12;
constexpr std::uint32_t PLL_FDIV = 0x7Fu << PLL_FDIV_shift;  ///< output = PS_CLK × PLL_FDIV
}  // namespace pll_ctrl

/// Bits of PLL_STATUS: that of the ARM PLL, shifted left by 1 for the DDR and by 2 for the IO PLL.
namespace pll_status {
constexpr std::uint32_t LOCK = 1u << 0;    ///< locked
constexpr std::uint32_t STABLE = 1u << 3;  ///< locked or bypassed
}  // namespace pll_status

/// Fields of ARM_PLL_CFG, DDR_PLL_CFG and IO_PLL_CFG.
namespace pll_cfg {
constexpr unsigned LOCK_CNT_shift = 12;
constexpr std::uint32_t LOCK_CNT = 0x3FFu << LOCK_CNT_shift;  ///< cycles until the lock bit rises
}  // namespace pll_cfg

/// Fields of clock control registers.
namespace clk_ctrl {
constexpr unsigned SRCSEL_shift = 4;
constexpr std::uint32_t SRCSEL = 3u << SRCSEL_shift;
constexpr unsigned DIVISOR0_shift = 8;
constexpr std::uint32_t DIVISOR0 = 0x3Fu
                                   << DIVISOR0_shift;  ///< also DIVISOR where it is the only one
constexpr unsigned DIVISOR1_shift = 20;
constexpr std::uint32_t DIVISOR1 = 0x3Fu << DIVISOR1_shift;
}  // namespace clk_ctrl

/// Values of SRCSEL in FPGAn_CLK_CTRL and UART_CLK_CTRL (0 and 1 are the same).
namespace peripheral_source {
constexpr std::uint32_t io_pll = 0;
constexpr std::uint32_t arm_pll = 2;
constexpr std::uint32_t ddr_pll = 3;
}  // namespace peripheral_source

/// Values of SRCSEL in ARM_CLK_CTRL (0 and 1 are the same).
namespace cpu_source {
constexpr std::uint32_t arm_pll = 0;
constexpr std::uint32_t ddr_pll = 2;
constexpr std::uint32_t io_pll = 3;
}  // namespace cpu_source

/// Bits of ARM_CLK_CTRL.
namespace arm_clk_ctrl {
constexpr std::uint32_t CPU_6OR4XCLKACT = 1u << 24;  ///< 0 stops the processors
}

/// Bits of UART_CLK_CTRL: those of UART 0; of UART 1 shifted left by 1.
namespace uart_clk_ctrl {
constexpr std::uint32_t CLKACT0 = 1u << 0;
}

/// Bits of FPGAn_THR_CTRL.
namespace thr_ctrl {
constexpr std::uint32_t CPU_START = 1u << 0;  ///< a change from 0 to 1 starts the count
constexpr std::uint32_t CNT_RST = 1u << 1;    ///< stored
}  // namespace thr_ctrl

/// Fields of FPGAn_THR_CNT and FPGAn_THR_STA.
namespace thr {
constexpr std::uint32_t LAST_CNT = 0xFFFF;   ///< of THR_CNT: clocks per start; 0: no throttle
constexpr std::uint32_t CURR_VAL = 0xFFFF;   ///< of THR_STA: clocks given since the start
constexpr std::uint32_t RUNNING = 1u << 16;  ///< of THR_STA: the clock runs
}  // namespace thr

/// Bits of FPGA_RST_CTRL.
namespace fpga_rst_ctrl {
constexpr std::uint32_t FPGA0_OUT_RST = 1u << 0;  ///< 1 pulls FCLK_RESET0_N low; n: << n
}

/// Bits of UART_RST_CTRL: those of UART 0; of UART 1 shifted left by 1.
namespace uart_rst_ctrl {
constexpr std::uint32_t UART0_CPU1X_RST = 1u << 0;  ///< 1 resets the bus side
constexpr std::uint32_t UART0_REF_RST = 1u << 2;    ///< 1 resets transmitter and receiver
}  // namespace uart_rst_ctrl

/// Bits of A9_CPU_RST_CTRL.
namespace a9_cpu_rst_ctrl {
constexpr std::uint32_t A9_RST0 = 1u << 0;
constexpr std::uint32_t A9_CLKSTOP0 = 1u << 4;
}  // namespace a9_cpu_rst_ctrl

/// Values of LVL_SHFTR_EN.
namespace lvl_shftr_en {
constexpr std::uint32_t all = 0xF;
constexpr std::uint32_t ps_to_pl = 0xA;
constexpr std::uint32_t none = 0x0;
constexpr std::uint32_t USER_LVL_SHFTR_EN = 0xF;
}  // namespace lvl_shftr_en

/// Bits of DDRIOB_DCI_CTRL.
namespace ddriob_dci_ctrl {
constexpr std::uint32_t RESET = 1u << 0;  ///< active low
constexpr std::uint32_t ENABLE = 1u << 1;
constexpr std::uint32_t UPDATE_CONTROL = 1u << 20;
}  // namespace ddriob_dci_ctrl

/// Bits of DDRIOB_DCI_STATUS.
namespace ddriob_dci_status {
constexpr std::uint32_t LOCK = 1u << 0;
constexpr std::uint32_t DONE = 1u << 13;
}  // namespace ddriob_dci_status

#define SLCR_ROW(name, reset, access, writable, ...) \
  { #name, name, reset, access, writable, __VA_ARGS__ }
#define SLCR_PIN_ROW(digits, pin, reset)                                     \
  {                                                                          \
    "MIO_PIN_" #digits, MIO_PIN(pin), reset, vp::Access::read_write, 0x3FFF, \
        "MIO pin " #pin ": function, buffer, pull-up", fields::mio_pin       \
  }

#define SLCR_PIN_DECADE(tens)                                                         \
  SLCR_PIN_ROW(tens##0, tens##0, 0x1601), SLCR_PIN_ROW(tens##1, tens##1, 0x1601),     \
      SLCR_PIN_ROW(tens##2, tens##2, 0x1601), SLCR_PIN_ROW(tens##3, tens##3, 0x1601), \
      SLCR_PIN_ROW(tens##4, tens##4, 0x1601), SLCR_PIN_ROW(tens##5, tens##5, 0x1601), \
      SLCR_PIN_ROW(tens##6, tens##6, 0x1601), SLCR_PIN_ROW(tens##7, tens##7, 0x1601), \
      SLCR_PIN_ROW(tens##8, tens##8, 0x1601), SLCR_PIN_ROW(tens##9, tens##9, 0x1601)

/// As the silicon leaves reset. Boot code programs clocks, pins and level shifters before the
/// program starts. PSS_IDCODE and BOOT_MODE have values of their own. The fields of GPIOB and
/// DDRIOB registers are not checked: all 32 bits are stored.
inline constexpr vp::RegisterInfo registers[] = {
    SLCR_ROW(SCL, 0x00000000, vp::Access::read_write, 0x00000001,
             "Secure configuration lock: 1 locks SCL, PSS_RST_CTRL, APU_CTRL and WDT_CLK_SEL until "
             "power-on"),
    SLCR_ROW(SLCR_LOCK, 0x00000000, vp::Access::write_only, 0x0000FFFF,
             "Writing 0x767B protects all registers against writes"),
    SLCR_ROW(SLCR_UNLOCK, 0x00000000, vp::Access::write_only, 0x0000FFFF,
             "Writing 0xDF0D allows writes"),
    SLCR_ROW(SLCR_LOCKSTA, 0x00000001, vp::Access::read_only, 0x00000000,
             "1 while writes are ignored"),
    SLCR_ROW(ARM_PLL_CTRL, 0x0001A008, vp::Access::read_write, 0x0007F01B,
             "ARM PLL: feedback divisor, bypass, power-down, reset", fields::pll_ctrl),
    SLCR_ROW(DDR_PLL_CTRL, 0x0001A008, vp::Access::read_write, 0x0007F01B,
             "DDR PLL: feedback divisor, bypass, power-down, reset", fields::pll_ctrl),
    SLCR_ROW(IO_PLL_CTRL, 0x0001A008, vp::Access::read_write, 0x0007F01B,
             "IO PLL: feedback divisor, bypass, power-down, reset", fields::pll_ctrl),
    SLCR_ROW(PLL_STATUS, 0x0000003F, vp::Access::read_only, 0x00000000,
             "Locked (bits 2:0) and stable (5:3): ARM, DDR, IO PLL from the lowest bit",
             fields::pll_status),
    SLCR_ROW(ARM_PLL_CFG, 0x00177EA0, vp::Access::read_write, 0x003FFFF0,
             "ARM PLL: lock counter, charge pump, loop resistor", fields::pll_cfg),
    SLCR_ROW(DDR_PLL_CFG, 0x00177EA0, vp::Access::read_write, 0x003FFFF0,
             "DDR PLL: lock counter, charge pump, loop resistor", fields::pll_cfg),
    SLCR_ROW(IO_PLL_CFG, 0x00177EA0, vp::Access::read_write, 0x003FFFF0,
             "IO PLL: lock counter, charge pump, loop resistor", fields::pll_cfg),
    SLCR_ROW(ARM_CLK_CTRL, 0x1F000400, vp::Access::read_write, 0x1F003F30,
             "CPU clock: source, divisor, gates", fields::arm_clk_ctrl),
    SLCR_ROW(DDR_CLK_CTRL, 0x18400003, vp::Access::read_write, 0xFFF00003,
             "DDR 2x and 3x clocks: divisors, gates", fields::ddr_clk_ctrl),
    SLCR_ROW(DCI_CLK_CTRL, 0x01E03201, vp::Access::read_write, 0x03F03F01,
             "DDR DCI clock: divisors, gate", fields::dci_clk_ctrl),
    SLCR_ROW(APER_CLK_CTRL, 0x01FFCCCD, vp::Access::read_write, 0x01FFCCCD,
             "AMBA clock gates of the peripherals", fields::aper_clk_ctrl),
    SLCR_ROW(USB0_CLK_CTRL, 0x00101941, vp::Access::read_write, 0x00000070,
             "USB 0 ULPI clock source", fields::usb_clk_ctrl),
    SLCR_ROW(USB1_CLK_CTRL, 0x00101941, vp::Access::read_write, 0x00000070,
             "USB 1 ULPI clock source", fields::usb_clk_ctrl),
    SLCR_ROW(GEM0_RCLK_CTRL, 0x00000001, vp::Access::read_write, 0x00000011,
             "Ethernet 0 receive clock: source, gate", fields::gem_rclk_ctrl),
    SLCR_ROW(GEM1_RCLK_CTRL, 0x00000001, vp::Access::read_write, 0x00000011,
             "Ethernet 1 receive clock: source, gate", fields::gem_rclk_ctrl),
    SLCR_ROW(GEM0_CLK_CTRL, 0x00003C01, vp::Access::read_write, 0x03F03F71,
             "Ethernet 0 reference clock: source, divisors, gate", fields::gem_clk_ctrl),
    SLCR_ROW(GEM1_CLK_CTRL, 0x00003C01, vp::Access::read_write, 0x03F03F71,
             "Ethernet 1 reference clock: source, divisors, gate", fields::gem_clk_ctrl),
    SLCR_ROW(SMC_CLK_CTRL, 0x00003C21, vp::Access::read_write, 0x00003F31,
             "Static memory reference clock: source, divisor, gate", fields::one_clk_ctrl),
    SLCR_ROW(LQSPI_CLK_CTRL, 0x00002821, vp::Access::read_write, 0x00003F31,
             "Quad SPI reference clock: source, divisor, gate", fields::one_clk_ctrl),
    SLCR_ROW(SDIO_CLK_CTRL, 0x00001E03, vp::Access::read_write, 0x00003F33,
             "SDIO reference clock: source, divisor, gates", fields::two_clk_ctrl),
    SLCR_ROW(UART_CLK_CTRL, 0x00003F03, vp::Access::read_write, 0x00003F33,
             "UART reference clock: source, divisor, gates", fields::two_clk_ctrl),
    SLCR_ROW(SPI_CLK_CTRL, 0x00003F03, vp::Access::read_write, 0x00003F33,
             "SPI reference clock: source, divisor, gates", fields::two_clk_ctrl),
    SLCR_ROW(CAN_CLK_CTRL, 0x00501903, vp::Access::read_write, 0x03F03F33,
             "CAN reference clock: source, divisors, gates", fields::can_clk_ctrl),
    SLCR_ROW(CAN_MIOCLK_CTRL, 0x00000000, vp::Access::read_write, 0x007F007F,
             "CAN clocks from MIO pins", fields::can_mioclk_ctrl),
    SLCR_ROW(DBG_CLK_CTRL, 0x00000F03, vp::Access::read_write, 0x00003F73,
             "Debug clock: source, divisor, gates", fields::dbg_clk_ctrl),
    SLCR_ROW(PCAP_CLK_CTRL, 0x00000F01, vp::Access::read_write, 0x00003F31,
             "Configuration port clock: source, divisor, gate", fields::one_clk_ctrl),
    SLCR_ROW(TOPSW_CLK_CTRL, 0x00000000, vp::Access::read_write, 0x00000001,
             "1 stops the central interconnect"),
    SLCR_ROW(FPGA0_CLK_CTRL, 0x00101800, vp::Access::read_write, 0x03F03F30,
             "FCLK_CLK0 to the PL: source, both divisors", fields::fpga_clk_ctrl),
    SLCR_ROW(FPGA0_THR_CTRL, 0x00000000, vp::Access::read_write, 0x0000000F,
             "FCLK_CLK0: throttle control", fields::fpga_thr_ctrl),
    SLCR_ROW(FPGA0_THR_CNT, 0x00000000, vp::Access::read_write, 0x000FFFFF,
             "FCLK_CLK0: clocks to give per start; 0 runs freely", fields::fpga_thr_cnt),
    SLCR_ROW(FPGA0_THR_STA, 0x00010000, vp::Access::read_only, 0x00000000,
             "FCLK_CLK0: running, clocks given", fields::fpga_thr_sta),
    SLCR_ROW(FPGA1_CLK_CTRL, 0x00101800, vp::Access::read_write, 0x03F03F30,
             "FCLK_CLK1 to the PL: source, both divisors", fields::fpga_clk_ctrl),
    SLCR_ROW(FPGA1_THR_CTRL, 0x00000000, vp::Access::read_write, 0x0000000F,
             "FCLK_CLK1: throttle control", fields::fpga_thr_ctrl),
    SLCR_ROW(FPGA1_THR_CNT, 0x00000000, vp::Access::read_write, 0x000FFFFF,
             "FCLK_CLK1: clocks to give per start; 0 runs freely", fields::fpga_thr_cnt),
    SLCR_ROW(FPGA1_THR_STA, 0x00010000, vp::Access::read_only, 0x00000000,
             "FCLK_CLK1: running, clocks given", fields::fpga_thr_sta),
    SLCR_ROW(FPGA2_CLK_CTRL, 0x00101800, vp::Access::read_write, 0x03F03F30,
             "FCLK_CLK2 to the PL: source, both divisors", fields::fpga_clk_ctrl),
    SLCR_ROW(FPGA2_THR_CTRL, 0x00000000, vp::Access::read_write, 0x0000000F,
             "FCLK_CLK2: throttle control", fields::fpga_thr_ctrl),
    SLCR_ROW(FPGA2_THR_CNT, 0x00000000, vp::Access::read_write, 0x000FFFFF,
             "FCLK_CLK2: clocks to give per start; 0 runs freely", fields::fpga_thr_cnt),
    SLCR_ROW(FPGA2_THR_STA, 0x00010000, vp::Access::read_only, 0x00000000,
             "FCLK_CLK2: running, clocks given", fields::fpga_thr_sta),
    SLCR_ROW(FPGA3_CLK_CTRL, 0x00101800, vp::Access::read_write, 0x03F03F30,
             "FCLK_CLK3 to the PL: source, both divisors", fields::fpga_clk_ctrl),
    SLCR_ROW(FPGA3_THR_CTRL, 0x00000000, vp::Access::read_write, 0x0000000F,
             "FCLK_CLK3: throttle control", fields::fpga_thr_ctrl),
    SLCR_ROW(FPGA3_THR_CNT, 0x00000000, vp::Access::read_write, 0x000FFFFF,
             "FCLK_CLK3: clocks to give per start; 0 runs freely", fields::fpga_thr_cnt),
    SLCR_ROW(FPGA3_THR_STA, 0x00010000, vp::Access::read_only, 0x00000000,
             "FCLK_CLK3: running, clocks given", fields::fpga_thr_sta),
    SLCR_ROW(CLK_621_TRUE, 0x00000001, vp::Access::read_write, 0x00000001,
             "CPU clock ratio: 1 is 6:2:1, 0 is 4:2:1"),
    SLCR_ROW(PSS_RST_CTRL, 0x00000000, vp::Access::read_write, 0x00000001,
             "1 resets the processing system"),
    SLCR_ROW(DDR_RST_CTRL, 0x00000000, vp::Access::read_write, 0x00000001, "DDR controller reset"),
    SLCR_ROW(TOPSW_RST_CTRL, 0x00000000, vp::Access::read_write, 0x00000001,
             "Central interconnect reset"),
    SLCR_ROW(DMAC_RST_CTRL, 0x00000000, vp::Access::read_write, 0x00000001, "DMA controller reset"),
    SLCR_ROW(USB_RST_CTRL, 0x00000000, vp::Access::read_write, 0x00000003, "USB reset",
             fields::two_rst_ctrl),
    SLCR_ROW(GEM_RST_CTRL, 0x00000000, vp::Access::read_write, 0x000000F3, "Ethernet reset",
             fields::gem_rst_ctrl),
    SLCR_ROW(SDIO_RST_CTRL, 0x00000000, vp::Access::read_write, 0x00000033, "SDIO reset",
             fields::sdio_rst_ctrl),
    SLCR_ROW(SPI_RST_CTRL, 0x00000000, vp::Access::read_write, 0x0000000F, "SPI reset",
             fields::four_rst_ctrl),
    SLCR_ROW(CAN_RST_CTRL, 0x00000000, vp::Access::read_write, 0x00000003, "CAN reset",
             fields::two_rst_ctrl),
    SLCR_ROW(I2C_RST_CTRL, 0x00000000, vp::Access::read_write, 0x00000003, "I2C reset",
             fields::two_rst_ctrl),
    SLCR_ROW(UART_RST_CTRL, 0x00000000, vp::Access::read_write, 0x0000000F, "UART reset",
             fields::four_rst_ctrl),
    SLCR_ROW(GPIO_RST_CTRL, 0x00000000, vp::Access::read_write, 0x00000001, "GPIO reset"),
    SLCR_ROW(LQSPI_RST_CTRL, 0x00000000, vp::Access::read_write, 0x00000003, "Quad SPI reset",
             fields::one_rst_ctrl),
    SLCR_ROW(SMC_RST_CTRL, 0x00000000, vp::Access::read_write, 0x00000003, "Static memory reset",
             fields::one_rst_ctrl),
    SLCR_ROW(OCM_RST_CTRL, 0x00000000, vp::Access::read_write, 0x00000001, "On-chip memory reset"),
    SLCR_ROW(FPGA_RST_CTRL, 0x01F33F0F, vp::Access::read_write, 0x01F33F0F,
             "Resets of the PL: bits 3:0 pull FCLK_RESETn low", fields::fpga_rst_ctrl),
    SLCR_ROW(A9_CPU_RST_CTRL, 0x00000000, vp::Access::read_write, 0x00000133,
             "Resets and clock stops of the CPUs", fields::a9_cpu_rst_ctrl),
    SLCR_ROW(RS_AWDT_CTRL, 0x00000000, vp::Access::read_write, 0x00000003,
             "What a CPU watchdog resets: 0 the system, 1 its CPU", fields::rs_awdt_ctrl),
    SLCR_ROW(REBOOT_STATUS, 0x00400000, vp::Access::read_write, 0xFFFFFFFF,
             "Reason of the last reset; survives all but power-on", fields::reboot_status),
    SLCR_ROW(BOOT_MODE, 0x00000000, vp::Access::read_only, 0x00000000,
             "Boot mode pins; the value is a build option", fields::boot_mode),
    SLCR_ROW(APU_CTRL, 0x00000000, vp::Access::read_write, 0x00000007,
             "Locks of processor and interrupt controller configuration", fields::apu_ctrl),
    SLCR_ROW(WDT_CLK_SEL, 0x00000000, vp::Access::read_write, 0x00000001,
             "Clock of the system watchdog"),
    SLCR_ROW(TZ_DMA_NS, 0x00000000, vp::Access::read_write, 0x00000001,
             "DMA controller: non-secure"),
    SLCR_ROW(TZ_DMA_IRQ_NS, 0x00000000, vp::Access::read_write, 0x0000FFFF,
             "DMA controller: non-secure interrupts"),
    SLCR_ROW(TZ_DMA_PERIPH_NS, 0x00000000, vp::Access::read_write, 0x0000000F,
             "DMA controller: non-secure peripheral requests"),
    SLCR_ROW(PSS_IDCODE, 0x00000000, vp::Access::read_only, 0x00000000,
             "Device id; the value is a build option", fields::pss_idcode),
    SLCR_ROW(DDR_URGENT, 0x00000000, vp::Access::read_write, 0x000000FF,
             "Urgent bits of the DDR ports"),
    SLCR_ROW(DDR_CAL_START, 0x00000000, vp::Access::write_only, 0x00000003,
             "Starts a DDR calibration"),
    SLCR_ROW(DDR_REF_START, 0x00000000, vp::Access::write_only, 0x00000001, "Starts a DDR refresh"),
    SLCR_ROW(DDR_CMD_STA, 0x00000000, vp::Access::read_only, 0x00000000, "DDR command queue"),
    SLCR_ROW(DDR_URGENT_SEL, 0x00000000, vp::Access::read_write, 0x0000FFFF,
             "Who drives the urgent bits"),
    SLCR_ROW(DDR_DFI_STATUS, 0x00000000, vp::Access::read_only, 0x00000000,
             "DDR calibration status"),
    SLCR_PIN_ROW(00, 0, 0x00001601),
    SLCR_PIN_ROW(01, 1, 0x00001601),
    SLCR_PIN_ROW(02, 2, 0x00000601),
    SLCR_PIN_ROW(03, 3, 0x00000601),
    SLCR_PIN_ROW(04, 4, 0x00000601),
    SLCR_PIN_ROW(05, 5, 0x00000601),
    SLCR_PIN_ROW(06, 6, 0x00000601),
    SLCR_PIN_ROW(07, 7, 0x00000601),
    SLCR_PIN_ROW(08, 8, 0x00000601),
    SLCR_PIN_ROW(09, 9, 0x00001601),
    SLCR_PIN_DECADE(1),
    SLCR_PIN_DECADE(2),
    SLCR_PIN_DECADE(3),
    SLCR_PIN_DECADE(4),
    SLCR_PIN_ROW(50, 50, 0x00001601),
    SLCR_PIN_ROW(51, 51, 0x00001601),
    SLCR_PIN_ROW(52, 52, 0x00001601),
    SLCR_PIN_ROW(53, 53, 0x00001601),
    SLCR_ROW(MIO_LOOPBACK, 0x00000000, vp::Access::read_write, 0x0000000F,
             "Loopbacks between peripherals inside the MIO", fields::mio_loopback),
    SLCR_ROW(MIO_MST_TRI0, 0xFFFFFFFF, vp::Access::read_write, 0xFFFFFFFF,
             "Tri-state of MIO pins 31:0"),
    SLCR_ROW(MIO_MST_TRI1, 0x003FFFFF, vp::Access::read_write, 0x003FFFFF,
             "Tri-state of MIO pins 53:32"),
    SLCR_ROW(SD0_WP_CD_SEL, 0x00000000, vp::Access::read_write, 0x003F003F,
             "SDIO 0: pins of write protect and card detect", fields::sd_wp_cd_sel),
    SLCR_ROW(SD1_WP_CD_SEL, 0x00000000, vp::Access::read_write, 0x003F003F,
             "SDIO 1: pins of write protect and card detect", fields::sd_wp_cd_sel),
    SLCR_ROW(LVL_SHFTR_EN, 0x00000000, vp::Access::read_write, 0x0000001F,
             "Level shifters between PS and PL: 0xF on, 0xA to the PL only, 0 off",
             fields::lvl_shftr_en),
    SLCR_ROW(OCM_CFG, 0x00000000, vp::Access::read_write, 0x0000001F,
             "Which quarters of the on-chip memory are at the top of the address space",
             fields::ocm_cfg),
    SLCR_ROW(GPIOB_CTRL, 0x00000000, vp::Access::read_write, 0xFFFFFFFF, "MIO buffer control"),
    SLCR_ROW(GPIOB_CFG_CMOS18, 0x00000000, vp::Access::read_write, 0xFFFFFFFF,
             "MIO buffers: CMOS 1.8 V"),
    SLCR_ROW(GPIOB_CFG_CMOS25, 0x00000000, vp::Access::read_write, 0xFFFFFFFF,
             "MIO buffers: CMOS 2.5 V"),
    SLCR_ROW(GPIOB_CFG_CMOS33, 0x00000000, vp::Access::read_write, 0xFFFFFFFF,
             "MIO buffers: CMOS 3.3 V"),
    SLCR_ROW(GPIOB_CFG_HSTL, 0x00000000, vp::Access::read_write, 0xFFFFFFFF, "MIO buffers: HSTL"),
    SLCR_ROW(GPIOB_DRVR_BIAS_CTRL, 0x00000000, vp::Access::read_write, 0xFFFFFFFF,
             "MIO buffers: driver bias"),
    SLCR_ROW(DDRIOB_ADDR0, 0x00000800, vp::Access::read_write, 0xFFFFFFFF, "DDR buffers: addr0"),
    SLCR_ROW(DDRIOB_ADDR1, 0x00000800, vp::Access::read_write, 0xFFFFFFFF, "DDR buffers: addr1"),
    SLCR_ROW(DDRIOB_DATA0, 0x00000800, vp::Access::read_write, 0xFFFFFFFF, "DDR buffers: data0"),
    SLCR_ROW(DDRIOB_DATA1, 0x00000800, vp::Access::read_write, 0xFFFFFFFF, "DDR buffers: data1"),
    SLCR_ROW(DDRIOB_DIFF0, 0x00000800, vp::Access::read_write, 0xFFFFFFFF, "DDR buffers: diff0"),
    SLCR_ROW(DDRIOB_DIFF1, 0x00000800, vp::Access::read_write, 0xFFFFFFFF, "DDR buffers: diff1"),
    SLCR_ROW(DDRIOB_CLOCK, 0x00000800, vp::Access::read_write, 0xFFFFFFFF, "DDR buffers: clock"),
    SLCR_ROW(DDRIOB_DRIVE_SLEW_ADDR, 0x00000000, vp::Access::read_write, 0xFFFFFFFF,
             "DDR buffers: drive and slew, addr"),
    SLCR_ROW(DDRIOB_DRIVE_SLEW_DATA, 0x00000000, vp::Access::read_write, 0xFFFFFFFF,
             "DDR buffers: drive and slew, data"),
    SLCR_ROW(DDRIOB_DRIVE_SLEW_DIFF, 0x00000000, vp::Access::read_write, 0xFFFFFFFF,
             "DDR buffers: drive and slew, diff"),
    SLCR_ROW(DDRIOB_DRIVE_SLEW_CLOCK, 0x00000000, vp::Access::read_write, 0xFFFFFFFF,
             "DDR buffers: drive and slew, clock"),
    SLCR_ROW(DDRIOB_DDR_CTRL, 0x00000000, vp::Access::read_write, 0xFFFFFFFF, "DDR buffer control"),
    SLCR_ROW(DDRIOB_DCI_CTRL, 0x00000020, vp::Access::read_write, 0xFFFFFFFF,
             "DDR buffers: impedance calibration (DCI)", fields::ddriob_dci_ctrl),
    SLCR_ROW(DDRIOB_DCI_STATUS, 0x00000000, vp::Access::read_only, 0x00000000,
             "DDR buffers: status of the impedance calibration", fields::ddriob_dci_status),
};

#undef SLCR_ROW
#undef SLCR_PIN_DECADE
#undef SLCR_PIN_ROW

}  // namespace slcr
