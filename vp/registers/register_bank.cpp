#include <vp/register_bank.h>

#include <cstring>
#include <stdexcept>
#include <string>

#include <vp/clock_scheduler.h>
#include <vp/register_route.h>
#include <vp/report.h>
#include <vp/text.h>

namespace vp {

namespace {

constexpr unsigned word_bytes = 4;

void store_word(unsigned char* data, std::uint32_t word) {
  std::memcpy(data, &word, word_bytes);
}

std::uint32_t load_word(const unsigned char* data) {
  std::uint32_t word = 0;
  std::memcpy(&word, data, word_bytes);
  return word;
}

}  // namespace

Register::Register(const RegisterInfo& info)
    : info_(info), value_(info.reset), reset_(info.reset), writable_(info.writable) {}

void Register::set_reset_value(std::uint32_t value) {
  reset_ = value_ = value;
}

void Register::remove() {
  removed_ = true;
  reset_ = value_ = 0;
}

std::uint32_t Register::seen() const {
  if (removed_ || info_.access == Access::write_only) return 0;
  return compute_ ? compute_() : value_;
}

std::uint32_t Register::read() {
  const std::uint32_t word = seen();
  ++use_.reads;
  use_.read_ones |= word;
  use_.read_zeros |= ~word;
  if (after_read_ && !removed_) after_read_(word);
  return word;
}

void Register::write(std::uint32_t word) {
  ++use_.writes;
  use_.written_ones |= word;
  use_.written_zeros |= ~word;
  if (removed_) return;
  apply_policy(word);
  if (after_write_) after_write_(word);
}

void Register::apply_policy(std::uint32_t word) {
  switch (info_.access) {
    case Access::read_write:
    case Access::write_only:
      value_ = (value_ & ~writable_) | (word & writable_);
      break;
    case Access::write_1_to_clear:
      value_ &= ~(word & writable_);
      break;
    case Access::write_1_to_set:
      value_ |= word & writable_;
      break;
    case Access::write_1_to_toggle:
      value_ ^= word & writable_;
      break;
    case Access::read_only:
      break;
  }
}

RegisterBank::RegisterBank(sc_core::sc_module_name name, RegisterTable table,
                           const RegisterBankOptions& options, ClockScheduler* scheduler)
    : sc_module(name),
      socket("socket"),
      options_(options),
      scheduler_(scheduler),
      by_word_((std::size_t{1} << options.address_bits) / word_bytes, nullptr) {
  for (std::size_t i = 0; i < table.count; ++i) {
    const RegisterInfo& info = table.first[i];
    const std::size_t word = info.offset / word_bytes;
    if (info.offset % word_bytes != 0 || word >= by_word_.size() || by_word_[word]) {
      throw std::logic_error(std::string(this->name()) + ": register " + info.name +
                             " is unaligned, out of the decoded range, or on top of another");
    }
    by_word_[word] = &registers_.emplace_back(info);
  }
  socket.register_b_transport(this, &RegisterBank::b_transport);
  socket.register_transport_dbg(this, &RegisterBank::transport_dbg);
  socket.register_get_direct_mem_ptr(this, &RegisterBank::get_direct_mem_ptr);
}

Register& RegisterBank::operator[](std::uint32_t offset) {
  Register* found = offset % word_bytes == 0 ? find(offset) : nullptr;
  if (!found) {
    throw std::logic_error(std::string(name()) + ": no register at offset " +
                           std::to_string(offset));
  }
  return *found;
}

void RegisterBank::reset() {
  for (Register& r : registers_) r.reset();
}

void RegisterBank::hold_in_reset(bool hold) {
  if (hold) reset();
  held_in_reset_ = hold;
}

Register* RegisterBank::find(std::uint64_t address) const {
  return by_word_[(address / word_bytes) % by_word_.size()];
}

void RegisterBank::synchronise() const {
  if (scheduler_) scheduler_->synchronise();
}

bool RegisterBank::all_bytes_enabled(const tlm::tlm_generic_payload& payload) const {
  const unsigned char* enables = payload.get_byte_enable_ptr();
  if (!enables) return true;
  const unsigned length = payload.get_byte_enable_length();
  for (unsigned i = 0; i < word_bytes; ++i) {
    if (length == 0 || enables[i % length] != TLM_BYTE_ENABLED) return false;
  }
  return true;
}

void RegisterBank::pass(const sc_core::sc_time& time) {
  if (scheduler_) {
    scheduler_->pass_until(scheduler_->now_ps() + to_ps(time));
  } else {
    sc_core::wait(time);
  }
}

void RegisterBank::b_transport(tlm::tlm_generic_payload& payload, sc_core::sc_time& delay) {
  if (delay != sc_core::SC_ZERO_TIME) {
    pass(delay);
    delay = sc_core::SC_ZERO_TIME;
  }
  synchronise();
  payload.set_response_status(access(payload));
}

tlm::tlm_response_status RegisterBank::access(tlm::tlm_generic_payload& payload) {
  if (payload.get_command() == tlm::TLM_IGNORE_COMMAND) return tlm::TLM_COMMAND_ERROR_RESPONSE;
  if (payload.get_data_length() != word_bytes || payload.get_streaming_width() < word_bytes ||
      payload.get_address() % word_bytes != 0) {
    return tlm::TLM_BURST_ERROR_RESPONSE;
  }
  if (options_.byte_enables == RegisterBankOptions::ByteEnables::error &&
      !all_bytes_enabled(payload)) {
    return tlm::TLM_BYTE_ENABLE_ERROR_RESPONSE;
  }
  Register* target = find(payload.get_address());
  if (!target && options_.holes == RegisterBankOptions::Holes::error) {
    return tlm::TLM_ADDRESS_ERROR_RESPONSE;
  }
  std::uint32_t word = payload.is_read() ? 0 : load_word(payload.get_data_ptr());
  tlm::tlm_response_status status = tlm::TLM_OK_RESPONSE;
  if (target) {
    status = access(*target, payload.is_read(), payload.get_address(), word);
  } else if (held_in_reset_) {
    status = refuse_in_reset(payload.get_address());
  } else {
    warn_of_missing_register(payload.is_read(), payload.get_address());
  }
  if (payload.is_read() && status == tlm::TLM_OK_RESPONSE) {
    store_word(payload.get_data_ptr(), word);
  }
  return status;
}

tlm::tlm_response_status RegisterBank::access_removed(Register& target, bool read,
                                                      std::uint64_t address, std::uint32_t& word) {
  if (read) {
    warn_of_missing_register(read, address);
    word = target.read();
  } else {
    warn_of_ignored_write(target, word);
    target.write(word);
  }
  return tlm::TLM_OK_RESPONSE;
}

tlm::tlm_response_status RegisterBank::refuse_in_reset(std::uint64_t address) const {
  warn(*this, "/markervp/register_bank/in_reset",
       hex(address) + " accessed while the device is held in reset: release its reset first");
  return tlm::TLM_GENERIC_ERROR_RESPONSE;
}

void RegisterBank::warn_of_ignored_write(const Register& target, std::uint32_t word) const {
  warn(*this, "/markervp/register_bank/ignored_write",
       hex(word) + " written to " + target.info_.name +
           (target.removed_ ? ", which this build does not have" : ", which is read only"));
}

void RegisterBank::warn_of_missing_register(bool read, std::uint64_t address) const {
  const Register* removed = find(address);
  warn(*this, "/markervp/register_bank/no_register",
       std::string(read ? "read of " : "write to ") + hex(address) +
           (removed ? std::string(" (") + removed->info_.name + "), which this build does not have"
                    : std::string(", where the device has no register")) +
           (read ? ": reads 0" : ": ignored"));
}

// Memory is never given, but the way here is.
bool RegisterBank::get_direct_mem_ptr(tlm::tlm_generic_payload& payload, tlm::tlm_dmi& dmi) {
  dmi.allow_none();
  dmi.set_start_address(0);
  dmi.set_end_address(~sc_dt::uint64{0});
  if (RegisterRoute* route = RegisterRoute::asked_for(payload)) {
    Register* target = find(payload.get_address());
    if (target && scheduler_) route->end_at(*this, *target, payload.get_address(), *scheduler_);
  }
  return false;
}

// Byte by byte, so that a debugger may ask for any range. A write sets the stored value and causes
// no effect.
std::uint32_t RegisterBank::peek(std::uint32_t offset) {
  synchronise();
  if (before_access_) before_access_();
  return (*this)[offset].seen();
}

unsigned RegisterBank::transport_dbg(tlm::tlm_generic_payload& payload) {
  if (payload.get_command() == tlm::TLM_IGNORE_COMMAND) return 0;
  synchronise();
  if (before_access_) before_access_();
  unsigned done = 0;
  for (; done < payload.get_data_length(); ++done) {
    const std::uint64_t address = payload.get_address() + done;
    const unsigned shift = 8 * (address % word_bytes);
    Register* target = find(address);
    if (!target && options_.holes == RegisterBankOptions::Holes::error) break;
    unsigned char& byte = payload.get_data_ptr()[done];
    if (payload.is_read()) {
      byte = static_cast<unsigned char>((target ? target->seen() : 0) >> shift);
    } else if (target && !target->removed_) {
      target->set((target->value() & ~(0xFFu << shift)) | std::uint32_t{byte} << shift);
    }
  }
  return done;
}

}  // namespace vp
