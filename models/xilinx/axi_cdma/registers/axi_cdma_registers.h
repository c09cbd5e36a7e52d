#pragma once

#include <vp/register_description.h>

#include <cstdint>

/// AXI Central DMA v4.1 (PG034), simple mode.
namespace axi_cdma {

constexpr std::uint32_t CDMACR = 0x00;
constexpr std::uint32_t CDMASR = 0x04;
constexpr std::uint32_t SA = 0x18;
constexpr std::uint32_t SA_MSB = 0x1C;
constexpr std::uint32_t DA = 0x20;
constexpr std::uint32_t DA_MSB = 0x24;
constexpr std::uint32_t BTT = 0x28;
constexpr unsigned address_bits = 6;

/// Bits of CDMACR.
namespace cdmacr {
constexpr std::uint32_t Reset = 1u << 2;
constexpr std::uint32_t Key_Hole_Read = 1u << 4;
constexpr std::uint32_t Key_Hole_Write = 1u << 5;
constexpr std::uint32_t IOC_IrqEn = 1u << 12;
constexpr std::uint32_t Err_IrqEn = 1u << 14;
}  // namespace cdmacr

/// Bits of CDMASR.
namespace cdmasr {
constexpr std::uint32_t Idle = 1u << 1;
constexpr std::uint32_t DMAIntErr = 1u << 4;
constexpr std::uint32_t DMASlvErr = 1u << 5;
constexpr std::uint32_t DMADecErr = 1u << 6;
constexpr std::uint32_t IOC_Irq = 1u << 12;
constexpr std::uint32_t Err_Irq = 1u << 14;
}  // namespace cdmasr

inline constexpr vp::RegisterField cdmasr_fields[] = {
    {"Idle", cdmasr::Idle, vp::Access::read_only, "no transfer is under way"},
    {"DMAIntErr", cdmasr::DMAIntErr, vp::Access::read_only, "an order that makes no sense"},
    {"DMASlvErr", cdmasr::DMASlvErr, vp::Access::read_only, "the memory answered SLVERR"},
    {"DMADecErr", cdmasr::DMADecErr, vp::Access::read_only, "the memory answered DECERR"},
    {"IOC_Irq", cdmasr::IOC_Irq, vp::Access::write_1_to_clear, "a transfer is complete"},
    {"Err_Irq", cdmasr::Err_Irq, vp::Access::write_1_to_clear, "a transfer failed"},
};

inline constexpr vp::RegisterInfo registers[] = {
    {"CDMACR", CDMACR, 0x00010000, vp::Access::read_write, 0x00005034, "Control"},
    {"CDMASR", CDMASR, 0x00000002, vp::Access::write_1_to_clear, 0x00005000, "Status",
     cdmasr_fields},
    {"SA", SA, 0, vp::Access::read_write, 0xFFFFFFFF, "Source"},
    {"SA_MSB", SA_MSB, 0, vp::Access::read_only, 0, "Source, upper half"},
    {"DA", DA, 0, vp::Access::read_write, 0xFFFFFFFF, "Destination"},
    {"DA_MSB", DA_MSB, 0, vp::Access::read_only, 0, "Destination, upper half"},
    {"BTT", BTT, 0, vp::Access::read_write, 0x03FFFFFF, "Bytes; a write starts the transfer"},
};

}  // namespace axi_cdma
