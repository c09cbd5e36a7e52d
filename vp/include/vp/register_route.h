#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <tlm>
#include <unordered_map>
#include <vector>

#include <vp/clock_scheduler.h>
#include <vp/mm_link.h>
#include <vp/register_bank.h>

namespace vp {

/// A part of a bus on which accesses take time: a port, an interconnect. It computes when an access
/// passes; the caller lets the time pass.
class BusStage {
 public:
  virtual ~BusStage() = default;

  /// One access in this stage.
  struct Passage {
    std::uint64_t earliest_ps;  ///< the request leaves at its first opportunity from then on:
    std::uint64_t leaves_ps;  ///< then, as the clocks ran when it entered; Clock::never: they stand
    std::uint64_t answer_ps;  ///< the answer leaves not before,
    std::uint64_t rest_ps;    ///< and not before this long after it came
  };
  /// An access arrives at `start_ps`, as the clocks run now. (It fills in `passage`: a returned
  /// struct would be copied, for every access.)
  virtual void enter(bool read, std::uint64_t start_ps, Passage& passage) const = 0;
  /// The first opportunity from `earliest_ps` on, as the clocks run now: one has changed while the
  /// request waited.
  virtual std::uint64_t leaves(std::uint64_t earliest_ps) const { return earliest_ps; }
  /// The longest time from `earliest_ps` until it leaves.
  virtual std::uint64_t longest_wait_ps() const { return 0; }
  /// Why it never leaves, for the message: "through gp0, but …".
  virtual std::string obstacle() const { return {}; }
};

/// Throws ProtocolError: an access never leaves `stage`, which sees it at `address`.
[[noreturn]] void report_bus_hang(const BusStage& stage, bool read, std::uint64_t address);

/// The way of one address from an initiator to its register, found once: the links on it, the
/// stages that take time, the register. An access does what b_transport() through all the sockets
/// does, at the same times, but without them.
///
/// It is found by get_direct_mem_ptr() with an extension: each part that knows the extension adds
/// itself and passes the call on. An observed link, a foreign interconnect and a foreign target do
/// not, and are reached through their sockets. As with direct memory, invalidate_direct_mem_ptr()
/// revokes it.
class RegisterRoute {
 public:
  /// The way from `first` on, which may turn out not to be known.
  RegisterRoute(MmLink& first, std::uint64_t address);
  RegisterRoute(const RegisterRoute&) = delete;
  RegisterRoute& operator=(const RegisterRoute&) = delete;

  bool known() const { return register_ != nullptr; }

  // For those on the way, from the initiator to the register.
  /// The route that `payload` asks for; null if it asks for ordinary direct memory.
  static RegisterRoute* asked_for(const tlm::tlm_generic_payload& payload);
  void add(MmLink& link) { links_.push_back(&link); }
  void add(const BusStage& stage, std::uint64_t address) { stops_.push_back({&stage, address}); }
  void end_at(RegisterBank& bank, Register& target, std::uint64_t address,
              ClockScheduler& scheduler);

  static constexpr std::size_t most_stages = 4;

  /// An access on its way. It may have left before the present time.
  class Access {
    friend class RegisterRoute;
    bool read_;
    std::size_t stage_;      ///< that it is in
    std::uint64_t time_ps_;  ///< when it entered that
    std::uint64_t changes_;  ///< of clocks, until then
    std::array<BusStage::Passage, most_stages> passages_;
  };
  /// An access leaves the initiator at `start_ps`.
  void begin(Access& access, bool read, std::uint64_t start_ps) const;
  /// How far it gets before `ps`, if the clocks run until then as they do now.
  void follow(Access& access, std::uint64_t ps) const;

  struct Answer {
    tlm::tlm_response_status status;
    std::uint64_t ps;  ///< when it is back at the initiator: now or later
  };
  /// An access from now on, which is `now_ps`. As complete().
  Answer transfer(std::uint64_t now_ps, bool read, std::uint32_t& word) {
    return single_stage_ ? transfer_through(*single_stage_, now_ps, read, word)
                         : transfer_through_all(now_ps, read, word);
  }
  /// Lets time pass until an access that leaves at `start_ps`, now or later, is at the register, if
  /// nothing happens meanwhile; arrive() follows. False: no time passes.
  bool reach_quietly(std::uint64_t start_ps, bool read, BusStage::Passage& passage) const {
    if (!single_stage_) return false;
    single_stage_->enter(read, start_ps, passage);
    return scheduler_->pass_quietly(passage.leaves_ps);
  }
  /// Reads or writes `word` at the register, on a route of one stage.
  Answer arrive(const BusStage::Passage& passage, bool read, std::uint32_t& word);
  /// Lets time pass until the access reaches the register, and reads or writes `word` there. From
  /// an SC_THREAD. Throws ProtocolError if a clock on the way is stopped.
  Answer complete(Access& access, std::uint32_t& word);

  // For polls.
  /// How long a read takes, where that does not depend on when it begins.
  std::optional<std::uint64_t> read_time_ps() const;
  /// When a read that leaves the initiator at `start_ps` reaches the register, as the clocks run
  /// now; Clock::never if one is stopped.
  std::uint64_t arrival_ps(std::uint64_t start_ps) const;
  /// Reads before this time return peek(), if the inputs of the device stay as they are now. 0 if
  /// the device does not tell.
  std::uint64_t stable_until_ps() const;
  /// What a read would return now.
  std::uint32_t peek() const;
  /// Counts reads that returned `word` as if they had been made.
  void credit_reads(std::uint64_t reads, std::uint32_t word);

 private:
  static constexpr std::uint64_t word_bytes = 4;

  struct Stop {
    const BusStage* stage;
    std::uint64_t address;  ///< as the stage sees it
  };
  void enter(Access& access, std::uint64_t ps) const {
    access.time_ps_ = ps;
    if (access.stage_ == stops_.size()) return;
    stops_[access.stage_].stage->enter(access.read_, ps, access.passages_[access.stage_]);
  }
  void leave(Access& access) const {
    const std::uint64_t ps = access.passages_[access.stage_].leaves_ps;
    ++access.stage_;
    enter(access, ps);
  }
  void wait_to_leave(const Stop& stop, BusStage::Passage& passage, bool read,
                     std::uint64_t& changes) const;
  bool look_again(const Stop& stop, BusStage::Passage& passage, std::uint64_t& changes) const;
  Answer transfer_through(const BusStage& stage, std::uint64_t now_ps, bool read,
                          std::uint32_t& word);
  Answer transfer_through_all(std::uint64_t now_ps, bool read, std::uint32_t& word);
  void count_on_links();
  void count(bool read, bool failed);

  /// Accesses without error, which every link on the way counts. The counters there may live longer
  /// than the route, or shorter.
  struct Counts {
    std::uint64_t reads = 0;
    std::uint64_t writes = 0;
  };

  std::vector<MmLink*> links_;
  std::shared_ptr<Counts> counts_ = std::make_shared<Counts>();
  std::vector<Stop> stops_;
  const BusStage* single_stage_ = nullptr;  ///< if there is one, as on nearly every route
  RegisterBank* bank_ = nullptr;
  Register* register_ = nullptr;
  std::uint64_t address_ = 0;  ///< as the bank sees it
  ClockScheduler* scheduler_ = nullptr;
};

/// The routes of one initiator, found when first used.
class RegisterRoutes {
 public:
  /// Takes the place of first.on_invalidate().
  explicit RegisterRoutes(MmLink& first);

  /// The route to `address`; null if it has none. Valid until the next call.
  RegisterRoute* find(std::uint64_t address) {
    const Recent& recent = recent_[slot(address)];
    return recent.address == address ? recent.route : look_up(address);
  }

 private:
  struct Recent {
    std::uint64_t address = ~std::uint64_t{0};
    RegisterRoute* route = nullptr;
  };
  static constexpr std::size_t recent_count = 64;
  static std::size_t slot(std::uint64_t address) {
    return (address >> 2 ^ address >> 12 ^ address >> 16) % recent_count;
  }
  RegisterRoute* look_up(std::uint64_t address);

  MmLink& first_;
  bool stale_ = false;
  std::array<Recent, recent_count> recent_;
  std::unordered_map<std::uint64_t, std::unique_ptr<RegisterRoute>> routes_;
};

// Register accesses are most of what a program does: the usual way is inlined.
inline void RegisterRoute::count(bool read, bool failed) {
  if (failed) {
    const auto command = read ? tlm::TLM_READ_COMMAND : tlm::TLM_WRITE_COMMAND;
    for (MmLink* link : links_) link->count(command, word_bytes, failed);
  } else {
    ++(read ? counts_->reads : counts_->writes);
  }
}

inline RegisterRoute::Answer RegisterRoute::transfer_through(const BusStage& stage,
                                                             std::uint64_t now_ps, bool read,
                                                             std::uint32_t& word) {
  std::uint64_t changes = scheduler_->clock_changes();
  BusStage::Passage passage;
  stage.enter(read, now_ps, passage);
  const Stop& stop = stops_.front();
  if (passage.leaves_ps == Clock::never) report_bus_hang(stage, read, stop.address);
  scheduler_->pass_from(now_ps, passage.leaves_ps);
  if (changes != scheduler_->clock_changes() && look_again(stop, passage, changes)) {
    wait_to_leave(stop, passage, read, changes);
  }
  return arrive(passage, read, word);
}

inline RegisterRoute::Answer RegisterRoute::arrive(const BusStage::Passage& passage, bool read,
                                                   std::uint32_t& word) {
  Answer answer{bank_->access(*register_, read, address_, word), 0};
  answer.ps = std::max(passage.leaves_ps + passage.rest_ps, passage.answer_ps);
  count(read, answer.status != tlm::TLM_OK_RESPONSE);
  return answer;
}

}  // namespace vp
