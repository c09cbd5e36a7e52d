// Two cores: how the second one starts, how they wait for each other, and what of it cannot work.
#include <ps/cpu/cores.h>

#include <algorithm>
#include <array>
#include <string>
#include <utility>

#include <ps/cpu/cpu.h>
#include <vp/report.h>
#include <vp/text.h>
#include <vp/unit.h>

namespace ps {

void RaceDetector::release(unsigned core, const volatile void* key) {
  Clocks& seen = released_.try_emplace(key).first->second;
  for (unsigned i = 0; i < cores; ++i) seen[i] = std::max(seen[i], clocks_[core][i]);
  ++clocks_[core][core];
}

void RaceDetector::acquire(unsigned core, const volatile void* key) {
  const auto released = released_.find(key);
  if (released == released_.end()) return;
  for (unsigned i = 0; i < cores; ++i)
    clocks_[core][i] = std::max(clocks_[core][i], released->second[i]);
}

// No cell reaches across `at` any more.
void RaceDetector::split(std::uintptr_t at) {
  auto cell = cells_.lower_bound(at);
  if (cell == cells_.begin()) return;
  --cell;
  if (cell->second.end <= at) return;
  cells_.emplace(at, cell->second);
  cell->second.end = at;
}

std::optional<RaceDetector::Access> RaceDetector::access(std::uintptr_t first, std::uintptr_t end,
                                                         const Access& access) {
  split(first);
  split(end);
  const unsigned other = 1 - access.core;
  const std::uint64_t known = clocks_[access.core][other];
  std::optional<Access> race;
  for (std::uintptr_t at = first; at < end;) {
    auto cell = cells_.lower_bound(at);
    if (cell == cells_.end() || cell->first != at) {  // not accessed before
      const std::uintptr_t gap_end = cell == cells_.end() ? end : std::min(end, cell->first);
      cell = cells_.emplace(at, Cell{gap_end, {}, {}}).first;
    }
    Cell& here = cell->second;
    if (here.writes[other].clock > known) race = here.writes[other].access;
    if (access.write && here.reads[other].clock > known) race = here.reads[other].access;
    auto& mine = access.write ? here.writes : here.reads;
    mine[access.core] = {clocks_[access.core][access.core], access};
    at = here.end;
  }
  return race;
}

namespace {

/// Where the boot code of the second core looks for its entry (UG585 6.1.10).
constexpr std::uint32_t start_address = 0xFFFF'FFF0;

// What orders accesses beside locks and words: keys of RaceDetector.
constexpr char start_key = 0, event_key = 0, software_interrupt_key = 0;

/// Without time and side effects; 0 where nothing answers.
std::uint32_t debug_word(vp::MmLink& bus, std::uint32_t address) {
  std::array<unsigned char, 4> bytes{};
  tlm::tlm_generic_payload payload;
  payload.set_read();
  payload.set_address(address);
  payload.set_data_ptr(bytes.data());
  payload.set_data_length(bytes.size());
  payload.set_streaming_width(bytes.size());
  if (bus.transport_debug(payload) != bytes.size()) return 0;
  return std::uint32_t{bytes[0]} | std::uint32_t{bytes[1]} << 8 | std::uint32_t{bytes[2]} << 16 |
         std::uint32_t{bytes[3]} << 24;
}

std::string name_of(const hal_lock& lock) {
  return lock.name ? "lock '" + std::string(lock.name) + "'" : "a lock without name";
}

}  // namespace

void Cpu::start_core(unsigned number, void (*entry)(void)) {
  catch_up();
  const std::string call = "hal_cpu_start(" + std::to_string(number) + "): ";
  if (number == 0 || number >= RaceDetector::cores)
    misuse(call + "there is no such core to start: it is 1");
  if (!entry) misuse(call + "the entry is null, so the core would stay in its boot code");
  if (cores_->all.size() <= number) {
    misuse(call + "the platform has one core: set ps.cores to 2");
  }
  const Cpu& core = *cores_->all[number];
  if (both_started_) misuse(call + "the core was started already: " + core.doing());
  // The loader puts a program elsewhere in each run; its place in the file stays.
  const auto address = reinterpret_cast<std::uintptr_t>(entry);
  const bool in_file = code_ && code_->contains(address);
  write32(start_address, static_cast<std::uint32_t>(in_file ? code_->place(address) : address));
  barrier();
  leave_boot_code(number, entry);
}

void Cpu::leave_boot_code(unsigned number, void (*entry)(void)) {
  for (Cpu* each : cores_->all) each->both_started_ = true;
  cores_->races.release(number_, &start_key);
  cores_->all[number]->entry_ = entry;
  scheduler_.notify(cores_->all[number]->start_);
}

// What programs do that know the boot code: they write the entry themselves, and send an event.
void Cpu::start_by_word() {
  const std::uint32_t entry = debug_word(m_axi, start_address);
  if (entry == 0) return;
  const std::string call = "the program starts core 1 at " + vp::hex(entry) + ", ";
  const bool has_code = code_ && code_->contains(entry);
  void (*const second)(void) = program_->second();
  if (!has_code && !second) {
    if (std::exchange(cores_->told_start, true)) return;
    vp::warn(
        *this, "/markervp/cpu/second_program",
        call +
            "where it has no code, and no other program is loaded: nothing runs there. Name the "
            "sources of the other program, markervp_add_program(… CORE1 file…), or start a "
            "function of this one: Xil_Out32(0xFFFFFFF0, (u32)function)");
  } else if (cores_->all.size() == 1) {
    misuse(call + "and the platform has one core: set ps.cores to 2");
  } else {
    leave_boot_code(1, has_code ? reinterpret_cast<void (*)(void)>(std::uintptr_t{entry}) : second);
  }
}

// In the boot code, which sleeps until an event.
void Cpu::await_start() {
  sc_core::wait(start_);
  scheduler_.come_last();
  scheduler_.set_lookahead(0);
  scheduler_.let_others_go_first();
  asleep = false;
  cores_->races.acquire(number_, &start_key);
  running_ = this;
  spend_cycles(settings_.interrupt_entry);
}

// The entry function has returned: on the chip the core falls asleep behind it.
void Cpu::sleep_for_good() {
  ProgramWatch::end();
  state_ = State::finished;
  end_ps_ = now_ps();
  asleep = true;
  scheduler_.set_lookahead(settings_.quantum);
  check_deadlock();
  if (moment_listener_) moment_listener_(Moment::call_over);
  ended_.notify(sc_core::SC_ZERO_TIME);
}

// The other one may see, or change, what this one has in memory.
bool Cpu::beside_other() const {
  return both_started_ && cores_->all.back()->state_ != State::finished;
}

bool Cpu::is_deaf() const {
  if (state_ != State::running) return state_ != State::waiting || !entry_;
  return (awaits_event_ || awaited_lock_) && !event_ && !irq_.interruptible();
}

std::string Cpu::doing() const {
  const std::string who = name();
  if (state_ == State::waiting) return who + (entry_ ? " is in its boot code" : " was not started");
  if (state_ == State::finished) return who + " ended at " + vp::format_time(end_ps_);
  if (awaited_lock_) {
    const Cores::Holder& holder = cores_->holders.at(awaited_lock_);
    return who + " waits for " + name_of(*awaited_lock_) + ", which " + holder.core->name() +
           " has held since " + vp::format_time(holder.since_ps);
  }
  if (awaits_event_)
    return who + " waits for an event" + (irq_.interruptible() ? "" : " with IRQ masked");
  return who + (asleep ? " waits for an interrupt" : " runs");
}

std::string Cpu::doing_elsewhere() const {
  std::string text;
  for (const Cpu* core : cores_->all) {
    if (core != this && both_started_) text += "; " + core->doing();
  }
  return text;
}

// This core is about to wait, or has ended. Only what can never end is one: a handler may wake a
// core that waits with IRQ unmasked.
void Cpu::check_deadlock() {
  const auto holder_of = [this](const Cpu& core) -> const Cpu* {
    return core.awaited_lock_ ? cores_->holders.at(core.awaited_lock_).core : nullptr;
  };
  bool stuck = std::all_of(cores_->all.begin(), cores_->all.end(),
                           [](Cpu* core) { return core->is_deaf(); });
  for (const Cpu* core : cores_->all) {
    const Cpu* holder = holder_of(*core);
    if (!holder) continue;
    stuck |= holder == core || holder->state_ == State::finished || holder_of(*holder) == core;
  }
  if (!stuck) return;
  std::string text;
  for (const Cpu* core : cores_->all) text += (text.empty() ? "deadlock: " : ", ") + core->doing();
  fail(text);
}

// Sleeps until an event, or an interrupt that may be taken.
void Cpu::doze_until_event() {
  while (!has_woken()) {
    check_deadlock();
    doze(std::max(deadline_.ps(), now_ps()),
         [](const void* cpu) { return static_cast<const Cpu*>(cpu)->has_woken(); });
    if (!has_woken())
      meet_deadline(awaited_lock_ ? "it waits for a lock" : "it waits for an event");
  }
  if (event_) cores_->races.acquire(number_, &event_key);
  event_ = false;
  take_interrupts();
}

void Cpu::wait_for_event() {
  catch_up();
  awaits_event_ = true;
  doze_until_event();
  awaits_event_ = false;
}

void Cpu::send_event() {
  barrier();
  if (number_ == 0 && !both_started_) start_by_word();
  cores_->races.release(number_, &event_key);
  for (Cpu* core : cores_->all) core->event_ = true;
  scheduler_.check_condition();
}

void Cpu::software_interrupt_raised() {
  if (both_started_) cores_->races.release(number_, &software_interrupt_key);
}

// What was done before a software interrupt was raised is seen by its handler.
void Cpu::handler_begins() {
  cores_->races.acquire(number_, &software_interrupt_key);
}

void Cpu::check_word(const char* call, const volatile std::uint32_t* word) {
  const auto address = reinterpret_cast<std::uintptr_t>(word);
  if (address % sizeof *word != 0)
    misuse(std::string(call) + "(): the address of the word is not a multiple of 4");
  look_at(const_cast<const std::uint32_t*>(word), sizeof *word);
}

std::uint32_t Cpu::load_acquire(const volatile std::uint32_t* word) {
  check_word("hal_load_acquire", word);
  barrier();
  cores_->races.acquire(number_, word);
  return *word;
}

void Cpu::store_release(volatile std::uint32_t* word, std::uint32_t value) {
  check_word("hal_store_release", word);
  barrier();
  put(word, value);
}

// What load_exclusive() of the other core saw is gone.
void Cpu::put(volatile std::uint32_t* word, std::uint32_t value) {
  *word = value;
  for (Cpu* core : cores_->all) core->monitor_.note_write(word);
  cores_->races.release(number_, word);
}

std::uint32_t Cpu::load_exclusive(const volatile std::uint32_t* word) {
  check_word("hal_load_exclusive", word);
  const std::uint32_t value = load_acquire(word);
  monitor_.reserve(word, value);
  return value;
}

bool Cpu::store_exclusive(volatile std::uint32_t* word, std::uint32_t value) {
  check_word("hal_store_exclusive", word);
  barrier();
  const bool stored = monitor_.take(word);
  if (stored) put(word, value);
  return stored;
}

// The way of ARM's manuals: LDREX, WFE while it is taken, STREX; a DMB behind.
void Cpu::acquire(hal_lock& lock) {
  check_word("hal_lock_acquire", &lock.taken);
  while (true) {
    const bool taken = load_exclusive(&lock.taken) != 0;
    if (!taken && store_exclusive(&lock.taken, 1)) break;
    if (!taken) continue;
    if (cores_->holders.count(&lock) == 0)
      misuse("hal_lock_acquire(): " + name_of(lock) +
             " is taken, but no core took it: initialise it with {0}");
    const hal_lock* const outer = std::exchange(awaited_lock_, &lock);
    doze_until_event();
    awaited_lock_ = outer;
  }
  cores_->holders[&lock] = {this, now_ps()};
}

void Cpu::release(hal_lock& lock) {
  check_word("hal_lock_release", &lock.taken);
  barrier();
  const auto holder = cores_->holders.find(&lock);
  if (holder == cores_->holders.end() || holder->second.core != this) {
    misuse("hal_lock_release(): " + name_of(lock) + " is not " + name() + "'s" +
           (holder == cores_->holders.end()
                ? ""
                : ", but " + std::string(holder->second.core->name()) + "'s"));
  }
  cores_->holders.erase(holder);
  put(&lock.taken, 0);
  send_event();
}

void Cpu::access_shared(bool write, const volatile void* data, std::size_t size) {
  if (!both_started_ || size == 0) return;
  const auto first = reinterpret_cast<std::uintptr_t>(data);
  const RaceDetector::Access now{number_, write, program_time_ps(), return_addresses()};
  const auto race = cores_->races.access(first, first + size, now);
  if (!race) return;
  const auto place = [this](const std::vector<std::uintptr_t>& calls) {
    const std::string text = code_ ? code_->path(calls) : std::string();
    return text.empty() ? text : " (" + text + ")";
  };
  const auto innermost = [this](const std::vector<std::uintptr_t>& calls) {
    const auto own = std::find_if(calls.begin(), calls.end(), [this](std::uintptr_t call) {
      return !code_ || code_->contains(call);
    });
    return own == calls.end() ? 0 : *own;
  };
  if (!cores_->told_races.insert(std::minmax({innermost(race->calls), innermost(now.calls)}))
           .second)
    return;
  vp::warn(*this, "/markervp/cpu/race",
           std::string(name()) + (write ? " writes " : " reads ") + std::to_string(size) +
               " bytes, some of which " + cores_->all[race->core]->name() +
               (race->write ? " wrote at " : " read at ") + vp::format_time(race->ps) +
               place(race->calls) +
               ", and nothing orders the two: take the same hal_lock around both, or hand the "
               "data over by an event");
}

}  // namespace ps
