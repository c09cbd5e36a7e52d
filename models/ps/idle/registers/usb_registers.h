#pragma once

#include <vp/register_description.h>

#include <cstdint>

/// USB controller of the Zynq-7000 (UG585 chapter 15 and appendix B.34), without a transceiver.
namespace usb {

constexpr std::uint32_t usb0_base = 0xE0002000, usb1_base = 0xE0003000;
constexpr std::uint32_t usb0_interrupt = 53, usb1_interrupt = 76;

constexpr std::uint32_t USBCMD = 0x140;
constexpr std::uint32_t USBSTS = 0x144;
constexpr std::uint32_t USBINTR = 0x148;
constexpr std::uint32_t ULPI_VIEWPORT = 0x170;
constexpr std::uint32_t ENDPTPRIME = 0x1B0;
constexpr std::uint32_t ENDPTFLUSH = 0x1B4;

constexpr std::uint32_t usbcmd_RST = 1u << 1, usbcmd_RS = 1u << 0;
constexpr std::uint32_t ulpi_wakeup = 1u << 31, ulpi_run = 1u << 30;

inline constexpr vp::RegisterInfo registers[] = {
    {"ID", 0x000, 0xE441FA05, vp::Access::read_only, 0, "Number of the module"},
    {"HWGENERAL", 0x004, 0x00000083, vp::Access::read_only, 0, "Build options"},
    {"HWHOST", 0x008, 0x10020001, vp::Access::read_only, 0, "Build options of the host"},
    {"HWDEVICE", 0x00C, 0x00000019, vp::Access::read_only, 0, "Build options of the device"},
    {"GPTIMER0LD", 0x080, 0, vp::Access::read_write, 0x00FFFFFF, "Timer 0: start value"},
    {"GPTIMER0CTRL", 0x084, 0, vp::Access::read_write, 0xFF000000, "Timer 0: control"},
    {"GPTIMER1LD", 0x088, 0, vp::Access::read_write, 0x00FFFFFF, "Timer 1: start value"},
    {"GPTIMER1CTRL", 0x08C, 0, vp::Access::read_write, 0xFF000000, "Timer 1: control"},
    {"SBUSCFG", 0x090, 0x00000003, vp::Access::read_write, 0x7, "Bursts"},
    {"CAPLENGTH", 0x100, 0x01000040, vp::Access::read_only, 0, "EHCI version"},
    {"HCSPARAMS", 0x104, 0x00010011, vp::Access::read_only, 0, "Ports"},
    {"HCCPARAMS", 0x108, 0x00000006, vp::Access::read_only, 0, "Capabilities of the host"},
    {"DCIVERSION", 0x120, 0x00000001, vp::Access::read_only, 0, "Version of the device"},
    {"DCCPARAMS", 0x124, 0x0000018C, vp::Access::read_only, 0, "Capabilities of the device"},
    {"USBCMD", USBCMD, 0x00080000, vp::Access::read_write, 0x00FFFFFF, "Command"},
    {"USBSTS", USBSTS, 0, vp::Access::write_1_to_clear, 0x03FFFFFF, "Events"},
    {"USBINTR", USBINTR, 0, vp::Access::read_write, 0x03FFFFFF, "Events that interrupt"},
    {"FRINDEX", 0x14C, 0, vp::Access::read_write, 0x3FFF, "Frame"},
    {"PERIODICLISTBASE", 0x154, 0, vp::Access::read_write, 0xFFFFF000, "Frame list, or address"},
    {"ASYNCLISTADDR", 0x158, 0, vp::Access::read_write, 0xFFFFFFE0, "Queue list"},
    {"TTCTRL", 0x15C, 0, vp::Access::read_write, 0x7F000000, "Transaction translator"},
    {"BURSTSIZE", 0x160, 0x00001010, vp::Access::read_write, 0x1FFFF, "Bursts of DMA"},
    {"TXFILLTUNING", 0x164, 0x00020000, vp::Access::read_write, 0x003FFFFF, "Fill of the FIFO"},
    {"ULPI_VIEWPORT", ULPI_VIEWPORT, 0x08000000, vp::Access::read_write, 0xFFFFFFFF,
     "Registers of the transceiver: none answers, reads give 0"},
    {"ENDPTNAK", 0x178, 0, vp::Access::write_1_to_clear, 0x0FFFFFFF, "Endpoints that refused"},
    {"ENDPTNAKEN", 0x17C, 0, vp::Access::read_write, 0x0FFFFFFF, "Such that interrupt"},
    {"CONFIGFLAG", 0x180, 0x00000001, vp::Access::read_only, 0, "All ports are here"},
    {"PORTSC1", 0x184, 0x8C000004, vp::Access::read_write, 0x007FFFFE, "Port: no device"},
    {"OTGSC", 0x1A4, 0x00001020, vp::Access::read_write, 0x7FFFFFFF, "On the go"},
    {"USBMODE", 0x1A8, 0, vp::Access::read_write, 0x3F, "Host or device"},
    {"ENDPTSETUPSTAT", 0x1AC, 0, vp::Access::write_1_to_clear, 0xFFF, "Setup packets"},
    {"ENDPTPRIME", ENDPTPRIME, 0, vp::Access::read_write, 0x0FFFFFFF, "Primes endpoints"},
    {"ENDPTFLUSH", ENDPTFLUSH, 0, vp::Access::read_write, 0x0FFFFFFF, "Flushes endpoints"},
    {"ENDPTSTAT", 0x1B8, 0, vp::Access::read_only, 0, "Endpoints that are ready"},
    {"ENDPTCOMPLETE", 0x1BC, 0, vp::Access::write_1_to_clear, 0x0FFFFFFF,
     "Endpoints that are done"},
    {"ENDPTCTRL0", 0x1C0, 0x00800080, vp::Access::read_write, 0x0001FFFF, "Endpoint 0"},
};

}  // namespace usb
