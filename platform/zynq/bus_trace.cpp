#include <zynq/bus_trace.h>

#include <vp/text.h>
#include <xilinx/axi_dma/memory_port.h>
#include <zynq/hardware_map.h>
#include <cstring>

namespace platform {

/// Single accesses of the processor.
class BusTrace::Accesses final : public vp::MmObserver {
 public:
  Accesses(const DeviceNames& names, vp::MmLink& link) : names_(names), link_(link) {
    const vp::HierarchyScope scope(link);
    text_ = std::make_unique<vp::TextSignal>("access", [this] { return access_; });
    link_.add_observer(*this);
  }
  ~Accesses() override { link_.remove_observer(*this); }
  Accesses(const Accesses&) = delete;
  Accesses& operator=(const Accesses&) = delete;

  void before(vp::MmLink&, tlm::tlm_generic_payload& payload, sc_core::sc_time&) override {
    std::uint32_t word = 0;
    std::memcpy(&word, payload.get_data_ptr(), sizeof word);
    const std::string name = names_.text(payload.get_address());
    access_ = (payload.is_read() ? "read " : "write ") +
              (name.empty() ? vp::hex(static_cast<std::uint32_t>(payload.get_address())) : name) +
              (payload.is_read() ? "" : " " + vp::hex(word));
    text_->touch();
  }
  void after(vp::MmLink&, tlm::tlm_generic_payload&, sc_core::sc_time&) override {
    access_.clear();
    text_->touch();
  }

 private:
  const DeviceNames& names_;
  vp::MmLink& link_;
  std::string access_;
  std::unique_ptr<vp::TextSignal> text_;
};

/// Bursts of a DMA engine.
class BusTrace::Bursts final : public vp::MmObserver {
 public:
  explicit Bursts(vp::MmLink& link) : link_(link) {
    const vp::HierarchyScope scope(link);
    text_ = std::make_unique<vp::TextSignal>("burst", [this] { return text(); });
    address_ = std::make_unique<vp::Signal<std::uint32_t>>("burst_address");
    bytes_ = std::make_unique<vp::Signal<std::uint32_t>>("burst_bytes");
    count_ = std::make_unique<vp::Signal<std::uint32_t>>("bursts");
    link_.add_observer(*this);
  }
  ~Bursts() override { link_.remove_observer(*this); }
  Bursts(const Bursts&) = delete;
  Bursts& operator=(const Bursts&) = delete;

  bool needs_transactions() const override { return false; }
  void after(vp::MmLink&, tlm::tlm_generic_payload& payload, sc_core::sc_time&) override {
    show(payload.is_read(), payload.get_address(), payload.get_data_length());
  }
  void direct(vp::MmLink&, tlm::tlm_command command, std::uint64_t address,
              std::uint64_t bytes) override {
    show(command == tlm::TLM_READ_COMMAND, address, bytes);
  }

 private:
  void show(bool read, std::uint64_t address, std::uint64_t bytes) {
    read_ = read;
    *address_ = static_cast<std::uint32_t>(address);
    *bytes_ = static_cast<std::uint32_t>(bytes);
    *count_ = *count_ + 1;
    text_->touch();
  }
  std::string text() const {
    if (*count_ == 0) return {};
    return std::string(read_ ? "read " : "write ") + vp::hex(address_->get()) + " " +
           std::to_string(bytes_->get()) + " bytes";
  }

  vp::MmLink& link_;
  bool read_ = false;
  std::unique_ptr<vp::TextSignal> text_;
  std::unique_ptr<vp::Signal<std::uint32_t>> address_, bytes_, count_;
};

BusTrace::BusTrace(Zynq& zynq) : names_(hardware_map(zynq)) {
  observers_.push_back(std::make_unique<Accesses>(names_, zynq.ps.cpu.m_axi));
  for (xilinx::MemoryPort* port : vp::all_below<xilinx::MemoryPort>(zynq.pl())) {
    observers_.push_back(std::make_unique<Bursts>(port->link));
  }
}

BusTrace::~BusTrace() = default;

}  // namespace platform
