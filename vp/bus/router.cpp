#include <vp/router.h>

#include <vp/clock.h>
#include <vp/clock_scheduler.h>
#include <vp/error.h>
#include <vp/ip.h>
#include <vp/text.h>

#include <algorithm>

namespace vp {

namespace {

std::string describe(const Router::Region& region) {
  return region.name + " (" + hex(region.base) + " to " + hex(region.last()) + ")";
}

/// Gives a payload the target's address while it lives.
class TranslatedAddress {
 public:
  TranslatedAddress(tlm::tlm_generic_payload& payload, const Router::Region& region)
      : payload_(payload), address_(payload.get_address()) {
    payload_.set_address(address_ - region.translation());
  }
  ~TranslatedAddress() { payload_.set_address(address_); }
  TranslatedAddress(const TranslatedAddress&) = delete;
  TranslatedAddress& operator=(const TranslatedAddress&) = delete;

 private:
  tlm::tlm_generic_payload& payload_;
  sc_dt::uint64 address_;
};

}  // namespace

Router::Router(sc_core::sc_module_name name, const Clock* clock)
    : sc_module(name), socket("socket"), clock_(clock) {
  socket.register_b_transport(this, &Router::b_transport);
  socket.register_transport_dbg(this, &Router::transport_dbg);
  socket.register_get_direct_mem_ptr(this, &Router::get_direct_mem_ptr);
  if (!clock_) return;
  read_latency_ = std::make_unique<Parameter<std::uint32_t>>(
      "read_latency", 0, Unit::cycles, Range<std::uint32_t>{0, 1'000}, Source::decision,
      "added to each read; the path from the PS has its time in the PS port");
  write_latency_ = std::make_unique<Parameter<std::uint32_t>>(
      "write_latency", 0, Unit::cycles, Range<std::uint32_t>{0, 1'000}, Source::decision,
      "added to each write; the path from the PS has its time in the PS port");
}

Router::~Router() = default;

tlm_utils::simple_initiator_socket<MmLink>& Router::map(const std::string& region_name,
                                                        std::uint64_t base, std::uint64_t size,
                                                        Addresses addresses) {
  if (size == 0 || base + (size - 1) < base) {
    throw InputError(std::string(name()) + ": the region of " + region_name + " at " + hex(base) +
                     " has a size of " + hex(size) +
                     ": it must be at least 1 and end within 64 bits");
  }
  Region region{region_name, base, size, addresses, nullptr};
  for (const Region& other : regions_) {
    if (region.base <= other.last() && other.base <= region.last()) {
      throw InputError(std::string(name()) + ": " + describe(region) + " overlaps " +
                       describe(other) + ": move one of them");
    }
  }
  const HierarchyScope scope(*this);
  links_.push_back(std::make_unique<MmLink>(region_name.c_str()));
  MmLink& link = *links_.back();
  link.on_invalidate(
      [this, &link](std::uint64_t first, std::uint64_t last) { invalidate(link, first, last); });
  region.link = &link;
  const auto place = std::upper_bound(regions_.begin(), regions_.end(), base,
                                      [](std::uint64_t b, const Region& r) { return b < r.base; });
  regions_.insert(place, region);
  return link.socket;
}

// SystemC would say that a port is not bound.
void Router::before_end_of_elaboration() {
  if (socket.get_base_port().bind_count() > 0) return;
  throw InputError(std::string(name()) + ": no master is connected, and it has " +
                   std::to_string(regions_.size()) +
                   " regions: bind a master to its socket, or leave it out");
}

const Router::Region* Router::find(std::uint64_t address) const {
  const auto above = std::upper_bound(regions_.begin(), regions_.end(), address,
                                      [](std::uint64_t a, const Region& r) { return a < r.base; });
  if (above == regions_.begin()) return nullptr;
  const Region& candidate = *(above - 1);
  return address <= candidate.last() ? &candidate : nullptr;
}

bool Router::takes_time() const {
  return clock_ && (*read_latency_ != 0 || *write_latency_ != 0);
}

std::uint64_t Router::access_time_ps(bool read) const {
  return clock_->duration_ps(read ? *read_latency_ : *write_latency_);
}

void Router::enter(bool read, std::uint64_t start_ps, Passage& passage) const {
  passage.earliest_ps = passage.leaves_ps = start_ps + access_time_ps(read);
  passage.answer_ps = passage.rest_ps = 0;
}

void Router::b_transport(int, tlm::tlm_generic_payload& payload, sc_core::sc_time& delay) {
  if (takes_time()) delay += from_ps(access_time_ps(payload.is_read()));
  const std::uint64_t address = payload.get_address();
  const unsigned length = payload.get_data_length();
  const Region* region = find(address);
  if (!region || (length > 0 && length - 1 > region->last() - address)) {
    ++decode_errors;
    payload.set_response_status(tlm::TLM_ADDRESS_ERROR_RESPONSE);
    return;
  }
  const TranslatedAddress translated(payload, *region);
  region->link->transport(payload, delay);
}

// Reaches as far as the region does: the byte count tells.
unsigned Router::transport_dbg(int, tlm::tlm_generic_payload& payload) {
  const Region* region = find(payload.get_address());
  if (!region) return 0;
  const std::uint64_t room = region->last() - payload.get_address() + 1;
  const unsigned length = payload.get_data_length();
  payload.set_data_length(static_cast<unsigned>(std::min<std::uint64_t>(length, room)));
  const TranslatedAddress translated(payload, *region);
  const unsigned done = region->link->transport_debug(payload);
  payload.set_data_length(length);
  return done;
}

// The window comes back in the target's addresses, and may be wider than what is mapped.
bool Router::get_direct_mem_ptr(int, tlm::tlm_generic_payload& payload, tlm::tlm_dmi& dmi) {
  const std::uint64_t address = payload.get_address();
  const Region* region = find(address);
  if (!region) {
    dmi.set_start_address(address);
    dmi.set_end_address(address);
    return false;
  }
  if (RegisterRoute* route = RegisterRoute::asked_for(payload)) {
    if (payload.get_data_length() - 1 > region->last() - address) return false;
    if (takes_time()) route->add(*this, address);
  }
  const TranslatedAddress translated(payload, *region);
  const bool given = region->link->direct_memory(payload, dmi);
  const std::uint64_t first = region->base - region->translation();
  const std::uint64_t last = region->last() - region->translation();
  if (given && dmi.get_start_address() < first) {
    dmi.set_dmi_ptr(dmi.get_dmi_ptr() + (first - dmi.get_start_address()));
  }
  dmi.set_start_address(std::max<std::uint64_t>(dmi.get_start_address(), first) +
                        region->translation());
  dmi.set_end_address(std::min<std::uint64_t>(dmi.get_end_address(), last) + region->translation());
  return given;
}

void Router::invalidate(const MmLink& link, std::uint64_t first, std::uint64_t last) {
  for (const Region& region : regions_) {
    if (region.link != &link) continue;
    const std::uint64_t low = std::max(first, region.base - region.translation());
    const std::uint64_t high = std::min(last, region.last() - region.translation());
    if (low > high) return;
    for (unsigned i = 0; i < socket.size(); ++i) {
      socket[static_cast<int>(i)]->invalidate_direct_mem_ptr(low + region.translation(),
                                                             high + region.translation());
    }
    return;
  }
}

Bridge::Bridge(sc_core::sc_module_name name, const Clock& clock, Leaves leaves)
    : sc_module(name), socket("socket"), clock_(clock), leaves_(leaves) {
  socket.register_b_transport(this, &Bridge::b_transport);
  socket.register_transport_dbg(this, &Bridge::transport_dbg);
  socket.register_get_direct_mem_ptr(this, &Bridge::get_direct_mem_ptr);
  link.on_invalidate([this](std::uint64_t first, std::uint64_t last) {
    socket->invalidate_direct_mem_ptr(first, last);
  });
}

void Bridge::enter(bool read, std::uint64_t start_ps, Passage& passage) const {
  if (hertz_ != clock_.frequency_hz()) follow_clock();
  const Times& t = read ? read_ : write_;
  passage.earliest_ps = start_ps + t.request;
  passage.leaves_ps = leaves(passage.earliest_ps);
  passage.answer_ps = start_ps + t.whole;
  passage.rest_ps = t.rest;
}

void Bridge::follow_clock() const {
  hertz_ = clock_.frequency_hz();
  read_ = times(true);
  write_ = times(false);
}

inline std::uint64_t Bridge::leaves(std::uint64_t earliest_ps) const {
  return leaves_ == Leaves::at_once ? earliest_ps : clock_.edge_at_or_after(earliest_ps);
}

std::uint64_t Bridge::longest_wait_ps() const {
  return leaves_ == Leaves::at_once ? 0 : clock_.duration_ps(1) + 1;
}

std::string Bridge::obstacle() const {
  return std::string("through ") + name() + ", but the clock " + clock_.name() + " is stopped";
}

void Bridge::b_transport(tlm::tlm_generic_payload& payload, sc_core::sc_time& delay) {
  ClockScheduler& scheduler = clock_.scheduler();
  Passage passage;
  enter(payload.is_read(), scheduler.now_ps() + to_ps(delay), passage);
  // Looks again after each wait: the clock may have changed meanwhile.
  for (std::uint64_t ps = passage.leaves_ps;; ps = leaves(passage.earliest_ps)) {
    if (ps == Clock::never) report_bus_hang(*this, payload.is_read(), payload.get_address());
    if (ps <= scheduler.now_ps()) break;
    scheduler.pass_until(ps);
  }
  delay = sc_core::SC_ZERO_TIME;
  link.transport(payload, delay);
  const std::uint64_t now = scheduler.now_ps();
  delay = from_ps(std::max(now + to_ps(delay) + passage.rest_ps, passage.answer_ps) - now);
}

bool Bridge::get_direct_mem_ptr(tlm::tlm_generic_payload& payload, tlm::tlm_dmi& dmi) {
  RegisterRoute* route = RegisterRoute::asked_for(payload);
  if (!route) return false;
  route->add(*this, payload.get_address());
  return link.direct_memory(payload, dmi);
}

unsigned Bridge::transport_dbg(tlm::tlm_generic_payload& payload) {
  return link.transport_debug(payload);
}

}  // namespace vp
