#pragma once

#include <cstdint>
#include <deque>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include <chip/system/zynq.h>
#include <facts/result.h>
#include <vp/file.h>
#include <vp/ip.h>
#include <vp/mm_link.h>
#include <vp/probe.h>
#include <vp/signal.h>

namespace platform {

/// Names of addresses, as `markervp map` prints them.
class DeviceNames {
 public:
  explicit DeviceNames(const facts::HardwareMap& map) : devices_(map.devices) {}

  /// Null where no device is.
  const facts::HardwareMap::Device* find(std::uint64_t address) const;
  /// Null if no device is called so.
  const facts::HardwareMap::Device* find(const std::string& name) const;
  /// "axi_gpio_0.GPIO_DATA", "ddr+0x1000"; "" where nothing is.
  std::string text(std::uint64_t address) const;
  /// The address of "axi_gpio_0.GPIO_DATA", "ddr+0x1000", "ddr" or "0x41200000". Throws
  /// vp::InputError that says what there is.
  std::uint32_t address_of(const std::string& name) const;
  /// Of all devices, for messages.
  std::vector<std::string> names() const;

 private:
  std::vector<facts::HardwareMap::Device> devices_;
};

/// One access of a processor, or one burst of a DMA.
struct BusAccess {
  std::uint64_t ps;  ///< when it left its initiator
  std::string initiator;
  bool by_processor;
  bool read;
  std::uint64_t address;
  std::uint64_t bytes;
  std::optional<std::uint32_t> word;  ///< that was read or written; of a burst none
  tlm::tlm_response_status response;
  const char* link;      ///< that it passed: "ps.cpu.m_axi"
  std::uint64_t end_ps;  ///< its answer is there; of a burst by direct access `ps`

  /// The word, "-" of one that could not be read, or the size of a burst: "0x00000000", "64 bytes".
  std::string value() const;
  /// "OK", "SLVERR", "DECERR".
  const char* answer() const;

  /// "320 ns  cpu  read  0x41200000  axi_gpio_0.GPIO_DATA  0x00000000  OK"
  std::string text(const DeviceNames& names) const;
};

/// Sees each access of the processors and each burst of a DMA, while it lives. The reads of a poll
/// are all made, one by one: no time changes by that.
class BusWatch {
 public:
  BusWatch(const BusWatch&) = delete;
  BusWatch& operator=(const BusWatch&) = delete;
  virtual ~BusWatch();

 protected:
  /// Addresses from first to last.
  struct Range {
    std::uint64_t first, last;
  };
  explicit BusWatch(Zynq& zynq);

  /// Only these; otherwise all.
  void watch_only(std::vector<Range> ranges) { ranges_ = std::move(ranges); }
  virtual void note(const BusAccess& access) = 0;
  const DeviceNames& names() const { return names_; }
  const Zynq& zynq() const { return zynq_; }

 private:
  /// One initiator. DMA engines may go on using direct access.
  class Observer : public vp::MmObserver {
   public:
    Observer(BusWatch& watch, vp::MmLink& link, std::string name, bool is_processor);
    ~Observer() override { link_.remove_observer(*this); }
    Observer(const Observer&) = delete;
    Observer& operator=(const Observer&) = delete;
    bool needs_transactions() const override { return is_processor_; }
    void before(vp::MmLink&, tlm::tlm_generic_payload&, sc_core::sc_time& delay) override;
    void after(vp::MmLink&, tlm::tlm_generic_payload&, sc_core::sc_time& delay) override;
    void direct(vp::MmLink&, tlm::tlm_command, std::uint64_t address, std::uint64_t bytes) override;

   private:
    BusWatch& watch_;
    vp::MmLink& link_;
    std::string name_;
    bool is_processor_;
    std::uint64_t start_ps_ = 0;
  };

  bool wanted(std::uint64_t address, std::uint64_t bytes) const;

  Zynq& zynq_;
  DeviceNames names_;
  std::vector<Range> ranges_;
  std::vector<std::unique_ptr<Observer>> observers_;
};

/// What a bus log is to contain.
struct BusLogOptions {
  std::string file;
  /// Devices ("axi_dma_0"), addresses ("0x41200000") or ranges of them, ends included
  /// ("0x41200000:0x4120FFFF"). Empty: everything.
  std::vector<std::string> filter;
};

/// Writes a line for each access.
class BusLog : public BusWatch {
 public:
  /// Throws vp::OutputError if the file cannot be written, vp::InputError if the filter names no
  /// device.
  BusLog(const BusLogOptions& options, Zynq& zynq);

  /// Ends the file, which has its name only now. Throws vp::OutputError if not all could be
  /// written.
  void close() { file_.commit(); }

 private:
  Range parse(const std::string& word) const;
  void note(const BusAccess& access) override;

  vp::OutputFile file_;
};

/// Which accesses of a run are asked for.
struct BusHistoryOptions {
  std::string at;  ///< "axi_dma_0.MM2S_DMASR", "ddr+0x100", "0x41200000"
  std::uint64_t before_ps = ~std::uint64_t{0};
  std::size_t count = 5;
  bool writes_only = false;
};

/// Remembers the last accesses of a word before some time, with the program's lines that made them.
/// Reads of one value in a row are one access, with the line of the first; so are writes, from one
/// line.
class BusHistory : public BusWatch {
 public:
  /// Throws vp::InputError for an invalid address.
  BusHistory(const BusHistoryOptions& options, Zynq& zynq);

  /// A line for each, the last one last.
  std::vector<std::string> lines() const;

 private:
  struct Entry {
    BusAccess last;
    std::uint64_t first_ps;
    std::uint64_t times;
    std::vector<std::uintptr_t> calls;
    std::string place;  ///< of a program that is elsewhere
  };
  void note(const BusAccess& access) override;

  BusHistoryOptions options_;
  std::deque<Entry> entries_;
};

/// Makes what passes the buses readable in a trace, below the link it passes:
///
///   ps.cpu.m_axi.access                     "write axi_dma_1.S2MM_LENGTH 0x00000080", then ""
///   pl.axi_dma_1.….burst                    "write 0x00100080 128 bytes", until the next
///   pl.axi_dma_1.….burst_address, burst_bytes, bursts
///
/// An access lasts from when it leaves the processor to when its answer is there. Polls make every
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
