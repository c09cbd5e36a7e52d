#pragma once

#include <vp/register_description.h>

/// The bit fields of the system level control registers, by the names of UG585 appendix B.28.
namespace slcr::fields {

inline constexpr vp::Access rw = vp::Access::read_write, ro = vp::Access::read_only;

inline constexpr vp::RegisterField pll_ctrl[] = {
    {"PLL_RESET", 0x00001, rw, "1 holds the PLL in reset"},
    {"PLL_PWRDWN", 0x00002, rw, "1 powers the PLL down"},
    {"PLL_BYPASS_QUAL", 0x00008, rw, "1: the bypass follows the strap pin, too"},
    {"PLL_BYPASS_FORCE", 0x00010, rw, "1: the output is PS_CLK"},
    {"PLL_FDIV", 0x7F000, rw, "output = PS_CLK * PLL_FDIV"},
};
inline constexpr vp::RegisterField pll_status[] = {
    {"ARM_PLL_LOCK", 0x01, ro, "ARM PLL locked"},
    {"DDR_PLL_LOCK", 0x02, ro, "DDR PLL locked"},
    {"IO_PLL_LOCK", 0x04, ro, "IO PLL locked"},
    {"ARM_PLL_STABLE", 0x08, ro, "ARM PLL locked or bypassed"},
    {"DDR_PLL_STABLE", 0x10, ro, "DDR PLL locked or bypassed"},
    {"IO_PLL_STABLE", 0x20, ro, "IO PLL locked or bypassed"},
};
inline constexpr vp::RegisterField pll_cfg[] = {
    {"PLL_RES", 0x0000F0, rw, "loop filter resistor"},
    {"PLL_CP", 0x000F00, rw, "charge pump"},
    {"LOCK_CNT", 0x3FF000, rw, "PS_CLK cycles until the lock bit rises"},
};
inline constexpr vp::RegisterField arm_clk_ctrl[] = {
    {"SRCSEL", 0x00000030, rw, "source: 0 and 1 ARM, 2 DDR, 3 IO PLL"},
    {"DIVISOR", 0x00003F00, rw, "divides the source"},
    {"CPU_6OR4XCLKACT", 0x01000000, rw, "0 stops the processors"},
    {"CPU_3OR2XCLKACT", 0x02000000, rw, "CPU_3x2x clock on"},
    {"CPU_2XCLKACT", 0x04000000, rw, "CPU_2x clock on"},
    {"CPU_1XCLKACT", 0x08000000, rw, "CPU_1x clock on"},
    {"CPU_PERI_CLKACT", 0x10000000, rw, "clock of the peripherals on"},
};
inline constexpr vp::RegisterField ddr_clk_ctrl[] = {
    {"DDR_3XCLKACT", 0x00000001, rw, "DDR_3x clock on"},
    {"DDR_2XCLKACT", 0x00000002, rw, "DDR_2x clock on"},
    {"DDR_3XCLK_DIVISOR", 0x03F00000, rw, "DDR PLL to DDR_3x"},
    {"DDR_2XCLK_DIVISOR", 0xFC000000, rw, "DDR PLL to DDR_2x"},
};
inline constexpr vp::RegisterField dci_clk_ctrl[] = {
    {"CLKACT", 0x00000001, rw, "clock on"},
    {"DIVISOR0", 0x00003F00, rw, "first divisor"},
    {"DIVISOR1", 0x03F00000, rw, "second divisor"},
};
inline constexpr vp::RegisterField ddriob_dci_ctrl[] = {
    {"RESET", 1u << 0, rw, "0 holds the calibration in reset; needed once: from 1 to 0 and back"},
    {"ENABLE", 1u << 1, rw, "1 calibrates the impedances"},
    {"VRP_TRI", 1u << 2, rw, "stored"},
    {"VRN_TRI", 1u << 3, rw, "stored"},
    {"VRP_OUT", 1u << 4, rw, "stored"},
    {"VRN_OUT", 1u << 5, rw, "stored"},
    {"NREF_OPT1", 3u << 6, rw, "stored"},
    {"NREF_OPT2", 7u << 8, rw, "stored"},
    {"NREF_OPT4", 7u << 11, rw, "stored"},
    {"PREF_OPT1", 3u << 14, rw, "stored"},
    {"PREF_OPT2", 7u << 17, rw, "stored"},
    {"UPDATE_CONTROL", 1u << 20, rw, "1: the impedances are not updated, DONE stays 0"},
    {"Reserved", 0xFFE10000, rw, "stored"},
};
inline constexpr vp::RegisterField ddriob_dci_status[] = {
    {"LOCK", 1u << 0, ro, "the impedances are calibrated; the model does so at once"},
    {"DONE", 1u << 13, ro, "as LOCK; boot code waits for it before it starts the DDR controller"},
};
inline constexpr vp::RegisterField aper_clk_ctrl[] = {
    {"DMA_CPU_2XCLKACT", 1u << 0, rw, "DMA controller on"},
    {"USB0_CPU_1XCLKACT", 1u << 2, rw, "USB 0 on"},
    {"USB1_CPU_1XCLKACT", 1u << 3, rw, "USB 1 on"},
    {"GEM0_CPU_1XCLKACT", 1u << 6, rw, "Ethernet 0 on"},
    {"GEM1_CPU_1XCLKACT", 1u << 7, rw, "Ethernet 1 on"},
    {"SDI0_CPU_1XCLKACT", 1u << 10, rw, "SDIO 0 on"},
    {"SDI1_CPU_1XCLKACT", 1u << 11, rw, "SDIO 1 on"},
    {"SPI0_CPU_1XCLKACT", 1u << 14, rw, "SPI 0 on"},
    {"SPI1_CPU_1XCLKACT", 1u << 15, rw, "SPI 1 on"},
    {"CAN0_CPU_1XCLKACT", 1u << 16, rw, "CAN 0 on"},
    {"CAN1_CPU_1XCLKACT", 1u << 17, rw, "CAN 1 on"},
    {"I2C0_CPU_1XCLKACT", 1u << 18, rw, "I2C 0 on"},
    {"I2C1_CPU_1XCLKACT", 1u << 19, rw, "I2C 1 on"},
    {"UART0_CPU_1XCLKACT", 1u << 20, rw, "UART 0 on"},
    {"UART1_CPU_1XCLKACT", 1u << 21, rw, "UART 1 on"},
    {"GPIO_CPU_1XCLKACT", 1u << 22, rw, "GPIO on"},
    {"LQSPI_CPU_1XCLKACT", 1u << 23, rw, "quad SPI on"},
    {"SMC_CPU_1XCLKACT", 1u << 24, rw, "static memory controller on"},
};
inline constexpr vp::RegisterField usb_clk_ctrl[] = {
    {"SRCSEL", 0x00000070, rw, "source: 4 to 7 are MIO pins"},
    {"Reserved", 0x00101901, ro, "as after reset"},
};
inline constexpr vp::RegisterField gem_rclk_ctrl[] = {
    {"CLKACT", 0x01, rw, "clock on"},
    {"SRCSEL", 0x10, rw, "source: 0 MIO, 1 EMIO"},
};
inline constexpr vp::RegisterField gem_clk_ctrl[] = {
    {"CLKACT", 0x00000001, rw, "clock on"},
    {"SRCSEL", 0x00000070, rw, "source: 0 and 1 IO, 2 ARM, 3 DDR PLL, 4 and more EMIO"},
    {"DIVISOR", 0x00003F00, rw, "first divisor"},
    {"DIVISOR1", 0x03F00000, rw, "second divisor"},
};
inline constexpr vp::RegisterField one_clk_ctrl[] = {
    {"CLKACT", 0x0001, rw, "clock on"},
    {"SRCSEL", 0x0030, rw, "source: 0 and 1 IO, 2 ARM, 3 DDR PLL"},
    {"DIVISOR", 0x3F00, rw, "divides the source"},
};
inline constexpr vp::RegisterField two_clk_ctrl[] = {
    {"CLKACT0", 0x0001, rw, "clock of device 0 on"},
    {"CLKACT1", 0x0002, rw, "clock of device 1 on"},
    {"SRCSEL", 0x0030, rw, "source: 0 and 1 IO, 2 ARM, 3 DDR PLL"},
    {"DIVISOR", 0x3F00, rw, "divides the source"},
};
inline constexpr vp::RegisterField can_clk_ctrl[] = {
    {"CLKACT0", 0x00000001, rw, "clock of CAN 0 on"},
    {"CLKACT1", 0x00000002, rw, "clock of CAN 1 on"},
    {"SRCSEL", 0x00000030, rw, "source: 0 and 1 IO, 2 ARM, 3 DDR PLL"},
    {"DIVISOR0", 0x00003F00, rw, "first divisor"},
    {"DIVISOR1", 0x03F00000, rw, "second divisor"},
};
inline constexpr vp::RegisterField can_mioclk_ctrl[] = {
    {"CAN0_MUX", 0x0000003F, rw, "CAN 0: MIO pin"},
    {"CAN0_REF_SEL", 0x00000040, rw, "CAN 0: 1 takes the clock from the pin"},
    {"CAN1_MUX", 0x003F0000, rw, "CAN 1: MIO pin"},
    {"CAN1_REF_SEL", 0x00400000, rw, "CAN 1: 1 takes the clock from the pin"},
};
inline constexpr vp::RegisterField dbg_clk_ctrl[] = {
    {"CLKACT_TRC", 0x0001, rw, "trace clock on"},
    {"CPU_1XCLKACT", 0x0002, rw, "debug access clock on"},
    {"SRCSEL", 0x0070, rw, "source: 0 and 1 IO, 2 ARM, 3 DDR PLL, 4 and more EMIO"},
    {"DIVISOR", 0x3F00, rw, "divides the source"},
};
inline constexpr vp::RegisterField fpga_clk_ctrl[] = {
    {"SRCSEL", 0x00000030, rw, "source: 0 and 1 IO, 2 ARM, 3 DDR PLL"},
    {"DIVISOR0", 0x00003F00, rw, "first divisor; 0 is taken as 1"},
    {"DIVISOR1", 0x03F00000, rw, "second divisor; 0 is taken as 1"},
};
inline constexpr vp::RegisterField fpga_thr_ctrl[] = {
    {"CPU_START", 0x1, rw, "a change from 0 to 1 starts the count"},
    {"CNT_RST", 0x2, rw, "stored"},
    {"Reserved", 0xC, rw, "stored"},
};
inline constexpr vp::RegisterField fpga_thr_cnt[] = {
    {"LAST_CNT", 0x0FFFF, rw, "clocks to give per start; 0 runs freely"},
    {"Reserved", 0xF0000, rw, "stored"},
};
inline constexpr vp::RegisterField fpga_thr_sta[] = {
    {"CURR_VAL", 0x0FFFF, ro, "clocks given since the start"},
    {"RUNNING", 0x10000, ro, "the clock runs"},
};
inline constexpr vp::RegisterField two_rst_ctrl[] = {
    {"CPU1X_RST0", 0x1, rw, "1 resets the bus side of device 0"},
    {"CPU1X_RST1", 0x2, rw, "1 resets the bus side of device 1"},
};
inline constexpr vp::RegisterField gem_rst_ctrl[] = {
    {"GEM0_CPU1X_RST", 0x01, rw, "1 resets the bus side of Ethernet 0"},
    {"GEM1_CPU1X_RST", 0x02, rw, "1 resets the bus side of Ethernet 1"},
    {"GEM0_RX_RST", 0x10, rw, "1 resets the receiver of Ethernet 0"},
    {"GEM1_RX_RST", 0x20, rw, "1 resets the receiver of Ethernet 1"},
    {"GEM0_REF_RST", 0x40, rw, "1 resets the transmitter of Ethernet 0"},
    {"GEM1_REF_RST", 0x80, rw, "1 resets the transmitter of Ethernet 1"},
};
inline constexpr vp::RegisterField sdio_rst_ctrl[] = {
    {"SDIO0_CPU1X_RST", 0x01, rw, "1 resets the bus side of SDIO 0"},
    {"SDIO1_CPU1X_RST", 0x02, rw, "1 resets the bus side of SDIO 1"},
    {"SDIO0_REF_RST", 0x10, rw, "1 resets the card side of SDIO 0"},
    {"SDIO1_REF_RST", 0x20, rw, "1 resets the card side of SDIO 1"},
};
inline constexpr vp::RegisterField four_rst_ctrl[] = {
    {"CPU1X_RST0", 0x1, rw, "1 resets the bus side of device 0"},
    {"CPU1X_RST1", 0x2, rw, "1 resets the bus side of device 1"},
    {"REF_RST0", 0x4, rw, "1 resets the line side of device 0"},
    {"REF_RST1", 0x8, rw, "1 resets the line side of device 1"},
};
inline constexpr vp::RegisterField one_rst_ctrl[] = {
    {"CPU1X_RST", 0x1, rw, "1 resets the bus side"},
    {"REF_RST", 0x2, rw, "1 resets the memory side"},
};
inline constexpr vp::RegisterField fpga_rst_ctrl[] = {
    {"FPGA0_OUT_RST", 0x00000001, rw, "1 pulls FCLK_RESET0_N low"},
    {"FPGA1_OUT_RST", 0x00000002, rw, "1 pulls FCLK_RESET1_N low"},
    {"FPGA2_OUT_RST", 0x00000004, rw, "1 pulls FCLK_RESET2_N low"},
    {"FPGA3_OUT_RST", 0x00000008, rw, "1 pulls FCLK_RESET3_N low"},
    {"Reserved", 0x01F33F00, rw, "write 0"},
};
inline constexpr vp::RegisterField a9_cpu_rst_ctrl[] = {
    {"A9_RST0", 0x001, rw, "1 resets CPU 0"},
    {"A9_RST1", 0x002, rw, "1 resets CPU 1"},
    {"A9_CLKSTOP0", 0x010, rw, "1 stops the clock of CPU 0"},
    {"A9_CLKSTOP1", 0x020, rw, "1 stops the clock of CPU 1"},
    {"PERI_RST", 0x100, rw, "1 resets the private peripherals"},
};
inline constexpr vp::RegisterField rs_awdt_ctrl[] = {
    {"CTRL0", 0x1, rw, "watchdog of CPU 0: 0 resets the system, 1 the CPU"},
    {"CTRL1", 0x2, rw, "watchdog of CPU 1: 0 resets the system, 1 the CPU"},
};
inline constexpr vp::RegisterField reboot_status[] = {
    {"BOOTROM_ERROR_CODE", 0x0000FFFF, rw, "what the boot ROM found wrong"},
    {"SWDT_RST", 1u << 16, rw, "last reset: system watchdog"},
    {"AWDT0_RST", 1u << 17, rw, "last reset: watchdog of CPU 0"},
    {"AWDT1_RST", 1u << 18, rw, "last reset: watchdog of CPU 1"},
    {"SLC_RST", 1u << 19, rw, "last reset: PSS_RST_CTRL"},
    {"DBG_RST", 1u << 20, rw, "last reset: debugger"},
    {"SRST_B", 1u << 21, rw, "last reset: pin PS_SRST_B"},
    {"POR", 1u << 22, rw, "last reset: power-on"},
    {"Reserved", 1u << 23, rw, "stored"},
    {"REBOOT_STATE", 0xFF000000, rw, "for software"},
};
inline constexpr vp::RegisterField boot_mode[] = {
    {"BOOT_MODE", 0x0F, ro, "pins: 5 SD card, 1 quad SPI, 0 JTAG"},
    {"PLL_BYPASS", 0x10, ro, "pin: the PLLs are bypassed"},
};
inline constexpr vp::RegisterField apu_ctrl[] = {
    {"CP15SDISABLE", 0x3, rw, "1 locks secure settings of a CPU, a bit each"},
    {"CFGSDISABLE", 0x4, rw, "1 locks the configuration of the interrupt controller"},
};
inline constexpr vp::RegisterField pss_idcode[] = {
    {"One", 0x00000001, ro, "1"},
    {"MANUFACTURER_ID", 0x00000FFE, ro, "0x49: Xilinx"},
    {"DEVICE", 0x0001F000, ro, "0x07: 7z020"},
    {"SUBFAMILY", 0x001E0000, ro, "0x9"},
    {"FAMILY", 0x0FE00000, ro, "0x1B"},
    {"REVISION", 0xF0000000, ro, "of the silicon"},
};
inline constexpr vp::RegisterField mio_pin[] = {
    {"TRI_ENABLE", 0x0001, rw, "1: not driven"},
    {"L0_SEL", 0x0002, rw, "function, first level"},
    {"L1_SEL", 0x0004, rw, "function, second level"},
    {"L2_SEL", 0x0018, rw, "function, third level"},
    {"L3_SEL", 0x00E0, rw, "function, fourth level"},
    {"Speed", 0x0100, rw, "1: fast edges"},
    {"IO_Type", 0x0E00, rw, "1 LVCMOS18, 2 LVCMOS25, 3 LVCMOS33, 4 HSTL"},
    {"PULLUP", 0x1000, rw, "1: pull-up on"},
    {"DisableRcvr", 0x2000, rw, "1: HSTL receiver off"},
};
inline constexpr vp::RegisterField mio_loopback[] = {
    {"SPI0_LOOP_SPI1", 0x1, rw, "1: SPI 0 and SPI 1 are connected"},
    {"UA0_LOOP_UA1", 0x2, rw, "1: UART 0 and UART 1 are connected"},
    {"CAN0_LOOP_CAN1", 0x4, rw, "1: CAN 0 and CAN 1 are connected"},
    {"I2C0_LOOP_I2C1", 0x8, rw, "1: I2C 0 and I2C 1 are connected"},
};
inline constexpr vp::RegisterField sd_wp_cd_sel[] = {
    {"SDIO_WP_SEL", 0x0000003F, rw, "pin of write protect"},
    {"SDIO_CD_SEL", 0x003F0000, rw, "pin of card detect"},
};
inline constexpr vp::RegisterField lvl_shftr_en[] = {
    {"USER_LVL_SHFTR_EN", 0x0F, rw, "0xF on, 0xA to the PL only, 0 off"},
    {"Reserved", 0x10, rw, "stored"},
};
inline constexpr vp::RegisterField ocm_cfg[] = {
    {"RAM_HI", 0x0F, rw, "a bit for each 64 KiB: 1 is at the top of the address space"},
    {"SWAP", 0x10, rw, "stored"},
};

}  // namespace slcr::fields
