#include <chip/watch/bus_log.h>

#include <algorithm>
#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <utility>

#include <chip/system/hardware_map.h>
#include <vp/error.h>
#include <vp/ip.h>
#include <vp/text.h>
#include <vp/unit.h>
#include <xilinx/axi_dma/dma_channel.h>

namespace platform {

const facts::HardwareMap::Device* DeviceNames::find(std::uint64_t address) const {
  for (const auto& device : devices_) {
    if (address >= device.base && address - device.base < device.size) return &device;
  }
  return nullptr;
}

const facts::HardwareMap::Device* DeviceNames::find(const std::string& name) const {
  for (const auto& device : devices_) {
    if (device.name == name) return &device;
  }
  return nullptr;
}

std::string DeviceNames::text(std::uint64_t address) const {
  const facts::HardwareMap::Device* device = find(address);
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

std::uint32_t DeviceNames::address_of(const std::string& name) const {
  if (const auto plain = vp::Decimal::parse(name)) {
    const auto whole = plain->whole();
    if (whole && *whole >= 0 && *whole <= 0xFFFF'FFFF) return static_cast<std::uint32_t>(*whole);
  }
  const std::size_t dot = name.find('.');
  const std::size_t plus = name.find('+');
  const std::string device_name = name.substr(0, std::min(dot, plus));
  const facts::HardwareMap::Device* device = find(device_name);
  if (!device)
    throw vp::InputError("no device '" + vp::excerpt(device_name) + "': choose " +
                         vp::one_of(names()));
  if (plus != std::string::npos) {
    const auto offset = vp::Decimal::parse(name.substr(plus + 1));
    const auto whole = offset ? offset->whole() : std::nullopt;
    if (whole && *whole >= 0 && static_cast<std::uint64_t>(*whole) < device->size)
      return static_cast<std::uint32_t>(device->base + static_cast<std::uint64_t>(*whole));
    throw vp::InputError("'" + name + "' is not in " + device_name);
  }
  std::vector<std::string> registers;
  for (const facts::HardwareMap::Register& r : device->registers) {
    if (dot != std::string::npos && r.name == name.substr(dot + 1))
      return static_cast<std::uint32_t>(device->base + r.offset);
    registers.push_back(r.name);
  }
  if (registers.empty() && dot == std::string::npos)
    return static_cast<std::uint32_t>(device->base);
  throw vp::InputError("no register '" + name + "': " + device_name + " has " +
                       vp::one_of(registers));
}

namespace {

/// The number of all of `text`, decimal or hexadecimal; false if it is not one.
bool number(const std::string& text, std::uint64_t& value) {
  char* end = nullptr;
  errno = 0;
  value = std::strtoull(text.c_str(), &end, 0);
  return !text.empty() && text[0] >= '0' && text[0] <= '9' && *end == '\0' && errno == 0;
}

/// What was read or written; none of a burst, and of a read that failed.
std::optional<std::uint32_t> word_of(const tlm::tlm_generic_payload& payload) {
  std::uint32_t word = 0;
  if (payload.get_data_length() != sizeof word) return std::nullopt;
  if (payload.is_read() && !payload.is_response_ok()) return std::nullopt;
  std::memcpy(&word, payload.get_data_ptr(), sizeof word);
  return word;
}

}  // namespace

std::string BusAccess::value() const {
  if (word) return vp::hex(*word);
  const bool is_word = bytes == sizeof(std::uint32_t) && response != tlm::TLM_OK_RESPONSE;
  return is_word ? "-" : std::to_string(bytes) + " bytes";
}

const char* BusAccess::answer() const {
  if (response == tlm::TLM_OK_RESPONSE) return "OK";
  return response == tlm::TLM_ADDRESS_ERROR_RESPONSE ? "DECERR" : "SLVERR";
}

std::string BusAccess::text(const DeviceNames& names) const {
  const std::string name = names.text(address);
  return vp::format_time(ps) + "  " + initiator + "  " + (read ? "read " : "write") + "  " +
         vp::hex(address) + "  " + (name.empty() ? "-" : name) + "  " + value() + "  " + answer();
}

BusWatch::Observer::Observer(BusWatch& watch, vp::MmLink& link, std::string name, bool is_processor)
    : watch_(watch), link_(link), name_(std::move(name)), is_processor_(is_processor) {
  link_.add_observer(*this);
}

void BusWatch::Observer::before(vp::MmLink&, tlm::tlm_generic_payload&, sc_core::sc_time& delay) {
  start_ps_ = watch_.zynq_.scheduler.now_ps() + vp::to_ps(delay);
}

void BusWatch::Observer::after(vp::MmLink&, tlm::tlm_generic_payload& payload,
                               sc_core::sc_time& delay) {
  if (!watch_.wanted(payload.get_address(), payload.get_data_length())) return;
  watch_.note({start_ps_, name_, is_processor_, payload.is_read(), payload.get_address(),
               payload.get_data_length(), word_of(payload), payload.get_response_status(),
               link_.name(), watch_.zynq_.scheduler.now_ps() + vp::to_ps(delay)});
}

void BusWatch::Observer::direct(vp::MmLink&, tlm::tlm_command command, std::uint64_t address,
                                std::uint64_t bytes) {
  if (!watch_.wanted(address, bytes)) return;
  const std::uint64_t ps = watch_.zynq_.scheduler.now_ps();
  watch_.note({ps, name_, is_processor_, command == tlm::TLM_READ_COMMAND, address, bytes,
               std::nullopt, tlm::TLM_OK_RESPONSE, link_.name(), ps});
}

BusWatch::BusWatch(Zynq& zynq) : zynq_(zynq), names_(hardware_map(zynq)) {
  const auto watch = [this](vp::MmLink& link, const char* name, bool is_processor) {
    observers_.push_back(std::make_unique<Observer>(*this, link, name, is_processor));
  };
  for (ps::Cpu* core : zynq.ps.cpus()) watch(core->m_axi, core->basename(), true);
  for (xilinx::MemoryPort* port : vp::all_below<xilinx::MemoryPort>(zynq.pl())) {
    watch(port->link, port->get_parent_object()->basename(), false);
  }
}

BusWatch::~BusWatch() = default;

bool BusWatch::wanted(std::uint64_t address, std::uint64_t bytes) const {
  return ranges_.empty() || std::any_of(ranges_.begin(), ranges_.end(), [&](const Range& range) {
           return address <= range.last &&
                  address + std::max<std::uint64_t>(bytes, 1) > range.first;
         });
}

BusLog::BusLog(const BusLogOptions& options, Zynq& zynq) : BusWatch(zynq), file_(options.file) {
  std::vector<Range> ranges;
  for (const std::string& word : options.filter) ranges.push_back(parse(word));
  watch_only(std::move(ranges));
}

void BusLog::note(const BusAccess& access) {
  file_.write(access.text(names()) + "\n");
}

BusWatch::Range BusLog::parse(const std::string& word) const {
  if (const auto* device = names().find(word))
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
                       vp::one_of(names().names()));
}

BusHistory::BusHistory(const BusHistoryOptions& options, Zynq& zynq)
    : BusWatch(zynq), options_(options) {
  const std::uint32_t address = names().address_of(options.at);
  watch_only({{address, address}});
}

void BusHistory::note(const BusAccess& access) {
  if (access.ps >= options_.before_ps || (options_.writes_only && access.read)) return;
  Entry* const last = entries_.empty() ? nullptr : &entries_.back();
  const bool same = last && last->last.initiator == access.initiator &&
                    last->last.read == access.read && last->last.word == access.word &&
                    last->last.bytes == access.bytes;
  // A poll reads thousands of times, and looking at the stack takes longer than all the rest.
  const bool polls = same && access.read;
  std::vector<std::uintptr_t> calls;
  std::string place;
  if (access.by_processor && !polls) {
    calls = ps::return_addresses();
    if (!zynq().ps.cpu.code()) place = zynq().ps.cpu.program_counter();
  }
  if (same && (polls || (last->calls == calls && last->place == place))) {
    last->last.ps = access.ps;
    ++last->times;
    return;
  }
  if (entries_.size() == options_.count) entries_.pop_front();
  entries_.push_back({access, access.ps, 1, std::move(calls), std::move(place)});
}

std::vector<std::string> BusHistory::lines() const {
  std::vector<std::string> lines;
  const ps::CodeLocator* const code = zynq().ps.cpu.code();
  for (const Entry& entry : entries_) {
    std::string line = entry.last.text(names());
    if (entry.times > 1) {
      line += "  (" + std::to_string(entry.times) + " times since " +
              vp::format_time(entry.first_ps) + ")";
    }
    const std::string place = code ? code->path(entry.calls) : entry.place;
    lines.push_back(line + (place.empty() ? "" : "  ") + place);
  }
  return lines;
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
