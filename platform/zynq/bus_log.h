#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include <report/result.h>
#include <vp/file.h>
#include <vp/ip.h>
#include <vp/mm_link.h>
#include <vp/probe.h>
#include <vp/signal.h>
#include <zynq/zynq.h>

namespace platform {

/// Names of addresses, as `markervp map` prints them.
class DeviceNames {
 public:
  explicit DeviceNames(const report::HardwareMap& map) : devices_(map.devices) {}

  /// Null where no device is.
  const report::HardwareMap::Device* find(std::uint64_t address) const;
  /// Null if no device is called so.
  const report::HardwareMap::Device* find(const std::string& name) const;
  /// "axi_gpio_0.GPIO_DATA", "ddr+0x1000"; "" where nothing is.
  std::string text(std::uint64_t address) const;
  /// Of all devices, for messages.
  std::vector<std::string> names() const;

 private:
  std::vector<report::HardwareMap::Device> devices_;
};

/// What a bus log is to contain.
struct BusLogOptions {
  std::string file;
  /// Devices ("axi_dma_0"), addresses ("0x41200000") or ranges of them, ends included
  /// ("0x41200000:0x4120FFFF"). Empty: everything.
  std::vector<std::string> filter;
};

/// Writes a line for each access of the processor and each burst of a DMA, while it lives:
///
///   320 ns  cpu  read  0x41200000  axi_gpio_0.GPIO_DATA  0x00000000  OK
///
/// The time is that at which the access leaves its initiator. The reads of a poll are all made, and
/// logged, one by one: no time changes by that. Bursts have their size in place of a value.
class BusLog {
 public:
  /// Throws vp::OutputError if the file cannot be written, vp::InputError if the filter names no
  /// device.
  BusLog(const BusLogOptions& options, Zynq& zynq);
  ~BusLog();
  BusLog(const BusLog&) = delete;
  BusLog& operator=(const BusLog&) = delete;

  /// Ends the file, which has its name only now. Throws vp::OutputError if not all could be
  /// written.
  void close() { file_.commit(); }

 private:
  struct Range {
    std::uint64_t first, last;
  };
  /// One initiator. DMA engines may go on using direct access.
  class Observer : public vp::MmObserver {
   public:
    Observer(BusLog& log, vp::MmLink& link, std::string name, bool transactions);
    ~Observer() override { link_.remove_observer(*this); }
    Observer(const Observer&) = delete;
    Observer& operator=(const Observer&) = delete;
    bool needs_transactions() const override { return transactions_; }
    void before(vp::MmLink&, tlm::tlm_generic_payload&, sc_core::sc_time& delay) override;
    void after(vp::MmLink&, tlm::tlm_generic_payload&, sc_core::sc_time& delay) override;
    void direct(vp::MmLink&, tlm::tlm_command, std::uint64_t address, std::uint64_t bytes) override;

   private:
    BusLog& log_;
    vp::MmLink& link_;
    std::string name_;
    bool transactions_;
    std::uint64_t start_ps_ = 0;
  };

  Range parse(const std::string& word) const;
  bool wanted(std::uint64_t address, std::uint64_t bytes) const;
  void write(std::uint64_t ps, const std::string& initiator, bool read, std::uint64_t address,
             const std::string& value, const std::string& answer);

  Zynq& zynq_;
  DeviceNames names_;
  std::vector<Range> ranges_;
  vp::OutputFile file_;
  std::vector<std::unique_ptr<Observer>> observers_;
};

/// Makes what passes the buses readable in a trace, below the link it passes:
///
///   ps.cpu.m_axi.access                     "write axi_dma_1.S2MM_LENGTH 0x00000080", then ""
///   pl.axi_dma_1.….burst                    "write 0x00100080 128 bytes", until the next
///   pl.axi_dma_1.….burst_address, burst_bytes, bursts
///
/// An access stands from when it leaves the processor to when its answer is there. Polls make every
/// read, no time changes by that.
class BusTrace {
 public:
  /// Before the simulation starts.
  explicit BusTrace(Zynq& zynq);
  ~BusTrace();
  BusTrace(const BusTrace&) = delete;
  BusTrace& operator=(const BusTrace&) = delete;

 private:
  class Accesses;
  class Bursts;

  DeviceNames names_;
  std::vector<std::unique_ptr<vp::MmObserver>> observers_;
};

}  // namespace platform
