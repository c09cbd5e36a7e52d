#include <zynq/bus_log.h>

#include <algorithm>
#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <utility>

#include <vp/error.h>
#include <vp/ip.h>
#include <vp/text.h>
#include <vp/unit.h>
#include <xilinx/axi_dma/dma_channel.h>
#include <zynq/hardware_map.h>

namespace platform {

const report::HardwareMap::Device* DeviceNames::find(std::uint64_t address) const {
  for (const auto& device : devices_) {
    if (address >= device.base && address - device.base < device.size) return &device;
  }
  return nullptr;
}

const report::HardwareMap::Device* DeviceNames::find(const std::string& name) const {
  for (const auto& device : devices_) {
    if (device.name == name) return &device;
  }
  return nullptr;
}

std::string DeviceNames::text(std::uint64_t address) const {
  const report::HardwareMap::Device* device = find(address);
  if (!device) return {};
  const std::uint64_t offset = address - device->base;
  for (const auto& r : device->registers) {
    if (r.offset == offset) return device->name + "." + r.name;
  }
  return device->name + "+" + vp::hex(offset);
}

std::vector<std::string> DeviceNames::names() const {
  std::vector<std::string> names;
  for (const auto& device : devices_) names.push_back(device.name);
  return names;
}

namespace {

/// The number of all of `text`, decimal or hexadecimal; false if it is none.
bool number(const std::string& text, std::uint64_t& value) {
  char* end = nullptr;
  errno = 0;
  value = std::strtoull(text.c_str(), &end, 0);
  return !text.empty() && text[0] >= '0' && text[0] <= '9' && *end == '\0' && errno == 0;
}

/// As AXI calls it.
const char* answer_of(const tlm::tlm_generic_payload& payload) {
  if (payload.is_response_ok()) return "OK";
  return payload.get_response_status() == tlm::TLM_ADDRESS_ERROR_RESPONSE ? "DECERR" : "SLVERR";
}

std::string value_of(const tlm::tlm_generic_payload& payload) {
  std::uint32_t word = 0;
  if (payload.get_data_length() != sizeof word) {
    return std::to_string(payload.get_data_length()) + " bytes";
  }
  if (payload.is_read() && !payload.is_response_ok()) return "-";
  std::memcpy(&word, payload.get_data_ptr(), sizeof word);
  return vp::hex(word);
}

}  // namespace

BusLog::Observer::Observer(BusLog& log, vp::MmLink& link, std::string name, bool transactions)
    : log_(log), link_(link), name_(std::move(name)), transactions_(transactions) {
  link_.add_observer(*this);
}

void BusLog::Observer::before(vp::MmLink&, tlm::tlm_generic_payload&, sc_core::sc_time& delay) {
  start_ps_ = log_.zynq_.scheduler.now_ps() + vp::to_ps(delay);
}

void BusLog::Observer::after(vp::MmLink&, tlm::tlm_generic_payload& payload, sc_core::sc_time&) {
  if (!log_.wanted(payload.get_address(), payload.get_data_length())) return;
  log_.write(start_ps_, name_, payload.is_read(), payload.get_address(), value_of(payload),
             answer_of(payload));
}

void BusLog::Observer::direct(vp::MmLink&, tlm::tlm_command command, std::uint64_t address,
                              std::uint64_t bytes) {
  if (!log_.wanted(address, bytes)) return;
  log_.write(log_.zynq_.scheduler.now_ps(), name_, command == tlm::TLM_READ_COMMAND, address,
             std::to_string(bytes) + " bytes", "OK");
}

BusLog::BusLog(const BusLogOptions& options, Zynq& zynq)
    : zynq_(zynq), names_(hardware_map(zynq)), file_(options.file) {
  for (const std::string& word : options.filter) ranges_.push_back(parse(word));
  const auto watch = [this](vp::MmLink& link, const char* name, bool transactions) {
    observers_.push_back(std::make_unique<Observer>(*this, link, name, transactions));
  };
  for (ps::Cpu* core : zynq.ps.cpus()) watch(core->m_axi, core->basename(), true);
  for (xilinx::MemoryPort* port : vp::all_below<xilinx::MemoryPort>(zynq.pl())) {
    watch(port->link, port->get_parent_object()->basename(), false);
  }
}

BusLog::~BusLog() = default;

BusLog::Range BusLog::parse(const std::string& word) const {
  if (const auto* device = names_.find(word))
    return {device->base, device->base + device->size - 1};
  Range range{};
  const std::size_t colon = word.find(':');
  if (number(word.substr(0, colon), range.first)) {
    range.last = range.first;
    if (colon == std::string::npos ||
        (number(word.substr(colon + 1), range.last) && range.last >= range.first)) {
      return range;
    }
  }
  throw vp::InputError("--log-bus-filter '" + word +
                       "': neither an address (0x41200000), a range of them "
                       "(0x41200000:0x4120FFFF), nor a device: " +
                       vp::one_of(names_.names()));
}

bool BusLog::wanted(std::uint64_t address, std::uint64_t bytes) const {
  return ranges_.empty() || std::any_of(ranges_.begin(), ranges_.end(), [&](const Range& range) {
           return address <= range.last &&
                  address + std::max<std::uint64_t>(bytes, 1) > range.first;
         });
}

void BusLog::write(std::uint64_t ps, const std::string& initiator, bool read, std::uint64_t address,
                   const std::string& value, const std::string& answer) {
  const std::string name = names_.text(address);
  file_.write(vp::format_time(ps) + "  " + initiator + "  " + (read ? "read " : "write") + "  " +
              vp::hex(address) + "  " + (name.empty() ? "-" : name) + "  " + value + "  " + answer +
              "\n");
}

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
  for (ps::Cpu* core : zynq.ps.cpus())
    observers_.push_back(std::make_unique<Accesses>(names_, core->m_axi));
  for (xilinx::MemoryPort* port : vp::all_below<xilinx::MemoryPort>(zynq.pl())) {
    observers_.push_back(std::make_unique<Bursts>(port->link));
  }
}

BusTrace::~BusTrace() = default;

}  // namespace platform
