#include <vp/register_route.h>

#include <algorithm>

#include <vp/error.h>
#include <vp/text.h>

namespace vp {

namespace {

/// Turns a request for direct memory into one for a route.
struct RouteRequest : tlm::tlm_extension<RouteRequest> {
  explicit RouteRequest(RegisterRoute& route) : route(&route) {}
  tlm_extension_base* clone() const override { return new RouteRequest(*route); }
  void copy_from(const tlm_extension_base& other) override {
    route = static_cast<const RouteRequest&>(other).route;
  }
  RegisterRoute* route;
};

}  // namespace

void report_bus_hang(const BusStage& stage, bool read, std::uint64_t address) {
  throw ProtocolError(std::string("bus hang: ") + (read ? "read of " : "write to ") + hex(address) +
                      " " + stage.obstacle());
}

RegisterRoute::RegisterRoute(MmLink& first, std::uint64_t address) {
  if (address % word_bytes != 0) return;
  RouteRequest request(*this);
  tlm::tlm_generic_payload payload;
  payload.set_extension(&request);
  payload.set_address(address);
  payload.set_read();
  payload.set_data_length(word_bytes);
  tlm::tlm_dmi dmi;
  first.direct_memory(payload, dmi);
  payload.clear_extension(&request);
  if (stops_.size() > most_stages) register_ = nullptr;
  if (stops_.size() == 1) single_stage_ = stops_.front().stage;
  if (register_) count_on_links();
}

void RegisterRoute::count_on_links() {
  const std::shared_ptr<const std::uint64_t> reads(counts_, &counts_->reads);
  const std::shared_ptr<const std::uint64_t> writes(counts_, &counts_->writes);
  for (MmLink* link : links_) {
    link->reads.include(reads, 1);
    link->bytes_read.include(reads, word_bytes);
    link->writes.include(writes, 1);
    link->bytes_written.include(writes, word_bytes);
  }
}

RegisterRoute* RegisterRoute::asked_for(const tlm::tlm_generic_payload& payload) {
  const auto* request = payload.get_extension<RouteRequest>();
  return request ? request->route : nullptr;
}

void RegisterRoute::end_at(RegisterBank& bank, Register& target, std::uint64_t address,
                           ClockScheduler& scheduler) {
  bank_ = &bank;
  register_ = &target;
  address_ = address;
  scheduler_ = &scheduler;
}

void RegisterRoute::begin(Access& access, bool read, std::uint64_t start_ps) const {
  access.read_ = read;
  access.stage_ = 0;
  access.changes_ = scheduler_->clock_changes();
  enter(access, start_ps);
}

void RegisterRoute::follow(Access& access, std::uint64_t ps) const {
  while (access.stage_ < stops_.size() && access.passages_[access.stage_].leaves_ps < ps) {
    leave(access);
  }
}

// `changes` counts those of clocks until the access entered the stage.
void RegisterRoute::wait_to_leave(const Stop& stop, BusStage::Passage& passage, bool read,
                                  std::uint64_t& changes) const {
  do {
    if (passage.leaves_ps == Clock::never) report_bus_hang(*stop.stage, read, stop.address);
    scheduler_->pass_until(passage.leaves_ps);
  } while (changes != scheduler_->clock_changes() && look_again(stop, passage, changes));
}

// A clock has changed while the access waited. True: it leaves at another time.
bool RegisterRoute::look_again(const Stop& stop, BusStage::Passage& passage,
                               std::uint64_t& changes) const {
  changes = scheduler_->clock_changes();
  passage.leaves_ps = std::max(stop.stage->leaves(passage.earliest_ps), scheduler_->now_ps());
  return passage.leaves_ps > scheduler_->now_ps();
}

RegisterRoute::Answer RegisterRoute::complete(Access& access, std::uint32_t& word) {
  while (access.stage_ < stops_.size()) {
    wait_to_leave(stops_[access.stage_], access.passages_[access.stage_], access.read_,
                  access.changes_);
    leave(access);
  }
  Answer answer{bank_->access(*register_, access.read_, address_, word), access.time_ps_};
  for (std::size_t i = stops_.size(); i > 0; --i) {
    const BusStage::Passage& passage = access.passages_[i - 1];
    answer.ps = std::max(answer.ps + passage.rest_ps, passage.answer_ps);
  }
  count(access.read_, answer.status != tlm::TLM_OK_RESPONSE);
  return answer;
}

RegisterRoute::Answer RegisterRoute::transfer_through_all(std::uint64_t now_ps, bool read,
                                                          std::uint32_t& word) {
  Access access;
  begin(access, read, now_ps);
  return complete(access, word);
}

// Constant where the first stage holds the answer back longer than anything behind it can.
std::optional<std::uint64_t> RegisterRoute::read_time_ps() const {
  std::uint64_t longest = 0;  // from entering the stage to leaving it with the answer
  std::uint64_t held = 0;     // the least of that, whatever comes behind
  std::uint64_t behind = 0;
  for (std::size_t i = stops_.size(); i > 0; --i) {
    const BusStage& stage = *stops_[i - 1].stage;
    BusStage::Passage passage{};
    stage.enter(true, 0, passage);
    behind = passage.earliest_ps + stage.longest_wait_ps() + longest + passage.rest_ps;
    held = passage.answer_ps;
    longest = std::max(behind, held);
  }
  if (behind <= held) return held;
  return std::nullopt;
}

std::uint64_t RegisterRoute::arrival_ps(std::uint64_t start_ps) const {
  std::uint64_t ps = start_ps;
  for (const Stop& stop : stops_) {
    BusStage::Passage passage{};
    stop.stage->enter(true, ps, passage);
    ps = passage.leaves_ps;
    if (ps == Clock::never) return ps;
  }
  return ps;
}

std::uint64_t RegisterRoute::stable_until_ps() const {
  return bank_->held_in_reset() ? 0 : register_->stable_until_ps();
}

std::uint32_t RegisterRoute::peek() const {
  return register_->seen();
}

void RegisterRoute::credit_reads(std::uint64_t reads, std::uint32_t word) {
  counts_->reads += reads;
  register_->credit_reads(reads, word);
}

RegisterRoutes::RegisterRoutes(MmLink& first) : first_(first) {
  first_.on_invalidate([this](std::uint64_t, std::uint64_t) {
    recent_.fill({});
    stale_ = true;  // an access may be on its way: forgotten before the next
  });
}

RegisterRoute* RegisterRoutes::look_up(std::uint64_t address) {
  if (stale_) routes_.clear();
  stale_ = false;
  auto& route = routes_[address];
  if (!route) route = std::make_unique<RegisterRoute>(first_, address);
  RegisterRoute* known = route->known() ? route.get() : nullptr;
  recent_[slot(address)] = {address, known};
  return known;
}

}  // namespace vp
