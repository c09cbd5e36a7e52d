#include <chip/system/wait_reason.h>

#include <algorithm>
#include <optional>
#include <vector>

#include <axi_dma_registers.h>
#include <axi_gpio_registers.h>
#include <chip/system/hardware_map.h>
#include <fmt/format.h>
#include <gic_registers.h>
#include <private_timer_registers.h>
#include <uart_registers.h>
#include <vp/ip.h>
#include <vp/unit.h>
#include <xilinx/axi_dma/axi_dma.h>
#include <xilinx/axi_dma/mm2s_channel.h>
#include <xilinx/axi_dma/s2mm_channel.h>

namespace platform {

namespace {

using MappedDevice = facts::HardwareMap::Device;

/// Registers of one device, by name.
class Look {
 public:
  Look(Zynq& zynq, const MappedDevice& device) : zynq_(zynq), device_(device) {}

  bool has(const std::string& name) const { return find(name) != nullptr; }
  std::uint32_t operator[](const std::string& name) const {
    const auto* const found = find(name);
    if (!found) return 0;
    return zynq_.peek(static_cast<std::uint32_t>(device_.base) + found->offset).value_or(0);
  }

 private:
  const facts::HardwareMap::Register* find(const std::string& name) const {
    const auto at = std::find_if(device_.registers.begin(), device_.registers.end(),
                                 [&](const auto& reg) { return reg.name == name; });
    return at == device_.registers.end() ? nullptr : &*at;
  }
  Zynq& zynq_;
  const MappedDevice& device_;
};

/// What of the interrupt controller stops interrupt `id`, which asks for the CPU.
std::string stopped_at_controller(const ps::Gic& gic, std::uint32_t id, bool irq_masked) {
  const ps::InterruptLogic& logic = gic.logic();
  const unsigned word = id / 32, bit = id % 32;
  if (!logic.enabled[id]) {
    std::string instead;
    if (id >= gic::first_spi && logic.enabled[id - gic::first_spi]) {
      instead = fmt::format(" ({} is enabled instead: the vendor's numbers are 32 higher)",
                            id - gic::first_spi);
    }
    return fmt::format(
        "it is not enabled at the interrupt controller, bit {} of ICDISER{} is 0{}: "
        "call XScuGic_Enable(&gic, {})",
        bit, word, instead, id);
  }
  if ((logic.icddcr & gic::icddcr::EnableS) == 0) {
    return "the distributor is off, bit 0 of ICDDCR is 0: call XScuGic_CfgInitialize()";
  }
  if ((logic.iccicr & gic::iccicr::EnableS) == 0) {
    return "the CPU interface is off, bit 0 of ICCICR is 0: call XScuGic_CfgInitialize()";
  }
  if (!logic.targeted[id]) {
    return fmt::format(
        "it goes to another core, by ICDIPTR{}: call "
        "XScuGic_InterruptMaptoCpu(&gic, this core, {})",
        id / 4, id);
  }
  if (logic.active[id]) {
    return "it was acknowledged and never ended: write what ICCIAR said to ICCEOIR, as "
           "XScuGic_InterruptHandler() does";
  }
  if (logic.priority[id] >= logic.iccpmr) {
    return fmt::format(
        "its priority 0x{:02X} is masked by ICCPMR, 0x{:02X}: give it a smaller "
        "number with XScuGic_SetPriorityTriggerType(&gic, {}, …)",
        logic.priority[id], logic.iccpmr, id);
  }
  if (logic.edge[id] && !logic.latched[id]) {
    return fmt::format(
        "it is taken as an edge, by ICDICFR{}, and its level does not rise again: "
        "call XScuGic_SetPriorityTriggerType(&gic, {}, priority, 1)",
        id / 16, id);
  }
  if (irq_masked) return "IRQ is masked in the CPU: call Xil_ExceptionEnable()";
  return {};
}

/// An interrupt of `device` is enabled at the controller.
bool has_interrupt_on(const ps::InterruptLogic& logic, const facts::HardwareMap& map,
                      const MappedDevice& device) {
  const std::string part = "." + device.name + ".";
  return std::any_of(map.interrupts.begin(), map.interrupts.end(), [&](const auto& interrupt) {
    return logic.enabled[interrupt.id] && interrupt.source.find(part) != std::string::npos;
  });
}

/// An event of a device that its own enable bit keeps from its interrupt line.
std::string kept_at_device(Zynq& zynq, const MappedDevice& device, bool means_interrupts) {
  const Look look(zynq, device);
  const auto dma = [&](const std::string& channel, const char* direction) -> std::string {
    const std::uint32_t kept =
        look[channel + "_DMASR"] & ~look[channel + "_DMACR"] & axi_dma::dmasr::interrupts;
    if (kept == 0) return {};
    return fmt::format(
        "{}.{}_DMASR has 0x{:08X} set, and the same bits of {}_DMACR are 0: call "
        "XAxiDma_IntrEnable(&dma, XAXIDMA_IRQ_ALL_MASK, {})",
        device.name, channel, kept, channel, direction);
  };
  if (look.has("MM2S_DMACR") || look.has("S2MM_DMACR")) {
    const std::string sends = dma("MM2S", "XAXIDMA_DMA_TO_DEVICE");
    return sends.empty() ? dma("S2MM", "XAXIDMA_DEVICE_TO_DMA") : sends;
  }
  // Its inputs set IP_ISR in a program without interrupts, too.
  if (look.has("GIER") && look["IP_ISR"] != 0 &&
      (means_interrupts || look["IP_IER"] != 0 || look["GIER"] != 0)) {
    if ((look["IP_ISR"] & ~look["IP_IER"]) != 0) {
      return fmt::format(
          "{}.IP_ISR has 0x{:X} set, and IP_IER is 0x{:X}: call "
          "XGpio_InterruptEnable(&gpio, {})",
          device.name, look["IP_ISR"], look["IP_IER"], look["IP_ISR"]);
    }
    if (look["GIER"] == 0) {
      return device.name + ".GIER is 0: call XGpio_InterruptGlobalEnable(&gpio)";
    }
  }
  if (device.base == private_timer::base) {
    const bool event = (look["INTERRUPT_STATUS"] & private_timer::status::Event_Flag) != 0;
    if (event && (look["CONTROL"] & private_timer::control::IRQ_Enable) == 0) {
      return device.name +
             " reached 0, and bit 2 of CONTROL (IRQ_Enable) is 0: call "
             "XScuTimer_EnableInterrupt(&timer)";
    }
    if (look["LOAD"] != 0 && (look["CONTROL"] & private_timer::control::Enable) == 0) {
      return device.name +
             " does not count, bit 0 of CONTROL (Enable) is 0: call "
             "XScuTimer_Start(&timer)";
    }
  }
  if (device.base == uart::uart0_base || device.base == uart::uart1_base) {
    constexpr std::uint32_t received = uart::event::RTRIG | uart::event::TIMEOUT;
    const std::uint32_t kept = look["ISR"] & ~look["IMR"] & received;
    if (kept != 0 && (means_interrupts || look["IMR"] != 0)) {
      return fmt::format(
          "{}.ISR has 0x{:X} set, and IMR is 0x{:X}: call "
          "XUartPs_SetInterruptMask(&uart, …)",
          device.name, kept, look["IMR"]);
    }
  }
  return {};
}

/// What a channel of an AXI DMA waits for, by its registers and its stream.
std::string state_of_channel(const Look& look, const std::string& device,
                             const std::string& channel, bool stream_waits, const char* stream) {
  namespace sr = axi_dma::dmasr;
  const std::uint32_t status = look[channel + "_DMASR"], control = look[channel + "_DMACR"];
  const std::string name = device + " " + channel;
  if ((status & sr::errors) != 0) {
    const bool length = (status & sr::DMAIntErr) != 0;
    const bool decode = (status & sr::DMADecErr) != 0;
    return name + " stopped with an error, " +
           (length   ? "DMAIntErr: the packet was longer than LENGTH, or LENGTH was 0"
            : decode ? "DMADecErr: its address is no memory that it reaches"
                     : "by a descriptor or an answer of the memory") +
           fmt::format(" ({}_DMASR is 0x{:08X}): reset it with XAxiDma_Reset()", channel, status);
  }
  if ((control & axi_dma::dmacr::RS) == 0) {
    return fmt::format(
        "{} is not started, bit 0 of {}_DMACR (RS) is 0: a transfer must be begun "
        "after XAxiDma_CfgInitialize(), and after each reset",
        name, channel);
  }
  if ((status & sr::Idle) != 0) return name + " is idle: nothing is under way";
  if ((status & sr::Halted) != 0) return name + " is halted";
  const bool descriptors = (status & sr::SGIncld) != 0;
  if (!descriptors && look[channel + "_LENGTH"] == 0) {
    return fmt::format(
        "{} runs, but {}_LENGTH was never written, which begins a transfer: call "
        "XAxiDma_SimpleTransfer()",
        name, channel);
  }
  if (stream_waits) return name + " has a transfer under way, and " + stream;
  return {};
}

/// A channel that the program polls, or, if it polls none, one that is to raise an interrupt.
bool is_of_interest(Zynq& zynq, const MappedDevice& device, bool sends,
                    std::optional<std::uint32_t> polled) {
  const Look look(zynq, device);
  const std::string control = sends ? "MM2S_DMACR" : "S2MM_DMACR";
  if (!look.has(control)) return false;
  if (!polled) {
    const bool idle = (look[sends ? "MM2S_DMASR" : "S2MM_DMASR"] & axi_dma::dmasr::Idle) != 0;
    return (look[control] & axi_dma::dmacr::IOC_IrqEn) != 0 && !idle;
  }
  const bool here = device.base <= *polled && *polled - device.base < device.size;
  return here && sends == (*polled - device.base < axi_dma::S2MM_DMACR);
}

std::string state_of_dma(Zynq& zynq, const MappedDevice& device, bool sends) {
  const Look look(zynq, device);
  bool waits = false;
  const char* stream = "";
  for (xilinx::AxiDma* dma : vp::all_below<xilinx::AxiDma>(zynq.pl())) {
    if (std::string(dma->basename()) != device.name) continue;
    if (sends && dma->include_mm2s) {
      waits = dma->mm2s().m_axis.tvalid.written() && !dma->mm2s().m_axis.tready;
      stream = "the slave of its stream holds TREADY low";
    } else if (!sends && dma->include_s2mm) {
      waits = !dma->s2mm().s_axis.tvalid;
      stream = "no data come on its stream: TVALID is low at the master, or TLAST never comes";
    }
  }
  return state_of_channel(look, device.name, sends ? "MM2S" : "S2MM", waits, stream);
}

/// The program looks for a character that nothing sends.
std::string nothing_typed(Zynq& zynq, const MappedDevice& device, std::uint32_t polled) {
  const bool is_uart = device.base == uart::uart0_base || device.base == uart::uart1_base;
  if (!is_uart || polled != device.base + uart::SR) return {};
  if ((Look(zynq, device)["SR"] & uart::sr::REMPTY) == 0) return {};
  return fmt::format(
      "nothing comes to {}: type with --terminal {}=NAME, or by uart() of a test in Python",
      device.name, device.name);
}

}  // namespace

std::string reason_of_wait(Zynq& zynq, const ps::Gic& gic, const ps::Surroundings::Wait& wait) {
  const facts::HardwareMap map = hardware_map(zynq);
  std::vector<std::string> reasons;
  const auto add = [&](const std::string& reason) {
    if (!reason.empty() && std::find(reasons.begin(), reasons.end(), reason) == reasons.end())
      reasons.push_back(reason);
  };
  static const decltype(map.devices) no_devices;
  const auto& devices = wait.only_stopped ? no_devices : map.devices;
  for (const MappedDevice& device : devices) {
    for (const bool sends : {true, false}) {
      if (is_of_interest(zynq, device, sends, wait.polled)) add(state_of_dma(zynq, device, sends));
    }
  }
  const ps::InterruptLogic& logic = gic.logic();
  for (const auto& interrupt : map.interrupts) {
    const bool high = logic.wire[interrupt.id];
    if (!high && !logic.latched[interrupt.id]) continue;
    const std::string why = stopped_at_controller(gic, interrupt.id, wait.irq_masked);
    if (why.empty()) continue;
    add(fmt::format("interrupt {} ({}) {} {}, but {}", interrupt.id, interrupt.source,
                    high ? "has been high since" : "rose at",
                    vp::format_time(gic.risen_ps(interrupt.id)), why));
  }
  for (const MappedDevice& device : devices) {
    // What a program polls is no reason to miss an interrupt of it.
    const bool polls_it =
        wait.polled && device.base <= *wait.polled && *wait.polled - device.base < device.size;
    const bool means_interrupts = has_interrupt_on(logic, map, device);
    if (!polls_it && (!wait.polled || means_interrupts))
      add(kept_at_device(zynq, device, means_interrupts));
    if (wait.polled) add(nothing_typed(zynq, device, *wait.polled));
  }
  std::string text;
  for (const std::string& reason : reasons) text += "; " + reason;
  return text;
}

}  // namespace platform
