#include <trace/transactions/axi_side.h>

#include <vp/text.h>

#include <algorithm>
#include <array>

#include <trace/clock_choice.h>

namespace platform::trace {

namespace {

constexpr std::array<const char*, 4> response_names = {"OKAY", "EXOKAY", "SLVERR", "DECERR"};
std::uint64_t rank_of(const std::string& response) {
  const auto found = std::find(response_names.begin(), response_names.end(), response);
  return found == response_names.end() ? 0
                                       : static_cast<std::uint64_t>(found - response_names.begin());
}

}  // namespace

AxiSide::AxiSide(const DecoderContext& context, const char* operation,
                 const std::string& request_channel, const std::string& data_channel)
    : Decoder(context),
      prefix_(context.surveyed.bus.kind == BusKind::axi4_lite ? "AXI4LITE_" : "AXI4_"),
      lite_(context.surveyed.bus.kind == BusKind::axi4_lite),
      operation_(operation),
      request_channel_(request_channel),
      request_(channel(request_channel, true,
                       {"ADDR", "ID", "LEN", "SIZE", "BURST", "LOCK", "CACHE", "PROT", "QOS",
                        "REGION", "USER"})) {
  const std::string small = vp::lower(request_channel);
  id_ = role(small + "id");
  address_ = role(small + "addr");
  length_ = role(small + "len");
  size_ = role(small + "size");
  burst_ = role(small + "burst");
  lock_ = role(small + "lock");
  cache_ = role(small + "cache");
  if (const auto data = role(vp::lower(data_channel) + "data"))
    bus_bytes_ = std::max(1U, width(*data) / bits_per_byte);
  follow_reset();
}

Handshake AxiSide::channel(const std::string& name, bool by_manager,
                           std::initializer_list<const char*> payload) {
  std::vector<Handshake::Payload> signals;
  for (const char* signal : payload) {
    if (const auto slot = role(vp::lower(name + signal))) signals.push_back({signal, *slot});
  }
  return Handshake(replay_, prefix_, name, by_manager, *role(vp::lower(name) + "valid"),
                   role(vp::lower(name) + "ready"), std::move(signals));
}

void AxiSide::reset(const SampleEdge& edge) {
  for (Request& request : open_) {
    request.transaction.add_note("reset at cycle " + std::to_string(edge.cycle));
    sink_.take(request.ticket, std::move(request.transaction));
  }
  open_.clear();
  accepting_ = false;
  request_.reset();
  forget();
}

void AxiSide::edge(const SampleEdge& edge) {
  const bool resets = in_reset();
  if (resets && !was_reset_) reset(edge);
  after_reset_ = was_reset_ && !resets;
  was_reset_ = resets;
  if (resets) return;
  sample_request(edge);
  sample_answers(edge);
}

void AxiSide::pass_on(Handshake& channel, Transaction* of) {
  for (Violation& violation : channel.broken()) report(std::move(violation), of);
  channel.broken().clear();
}

void AxiSide::sample_request(const SampleEdge& edge) {
  sample(request_, edge);
  if (request_.withdrawn() && accepting_) {
    Request& request = open_.back();
    pass_on(request_, &request.transaction);
    request.transaction.add_note("withdrawn before it was accepted");
    sink_.take(request.ticket, std::move(request.transaction));
    open_.pop_back();
    accepting_ = false;
  }
  if (request_.begins()) begin(edge);
  pass_on(request_, accepting_ ? &open_.back().transaction : nullptr);
  if (!request_.beat()) return;
  Request& request = open_.back();
  // A request that changes while it waits is the one that passes; that it did is reported.
  if (request_.waited(edge) != 0) read_burst(request, edge);
  request.accepted = true;
  request.moved = edge;
  request.transaction.accepted_ps = edge.ps;
  request.transaction.request_wait = request_.waited(edge);
  accepting_ = false;
  moved(edge, request_channel_ + " of " + named(request));
}

void AxiSide::begin(const SampleEdge& edge) {
  if (open_.size() == most_open) give_up_oldest();
  Request request;
  request.transaction = begun(operation_, edge);
  request.ticket = sink_.open();
  request.moved = edge;
  read_burst(request, edge);
  request.transaction.outstanding = open_.size();
  open_.push_back(std::move(request));
  accepting_ = true;
  for (const AxiRequestFault& fault : axi_request_faults(open_.back().burst))
    report_rule(edge, "ERRM_" + request_channel_ + fault.rule, fault.detail,
                &open_.back().transaction);
  requested(open_.back(), edge);
}

void AxiSide::read_burst(Request& request, const SampleEdge& /*edge*/) {
  Transaction& one = request.transaction;
  AxiBurst& burst = request.burst;
  one.id = number(id_);
  request.write_id = one.id;
  one.address = number(address_);
  burst.address = one.address.value_or(0);
  burst.beats = number(length_).value_or(0) + 1;
  burst.bus_bytes = bus_bytes_;
  burst.size = bus_bytes_;
  if (const auto size = number(size_))
    burst.size = std::uint64_t{1} << std::min<std::uint64_t>(*size, 7);
  burst.type = static_cast<AxiBurst::Type>(number(burst_).value_or(1) & 3U);
  burst.exclusive = number(lock_).value_or(0) == 1;
  burst.cache = number(cache_);
  one.beats = burst.beats;
  one.size = burst.size;
  one.burst = lite_ ? "" : axi_burst_name(burst.type);
}

void AxiSide::note_response(Request& request, const SampleEdge& edge,
                            std::optional<Replay::Slot> code, const std::string& channel) {
  const std::uint64_t value = number(code).value_or(0) & 3U;
  Transaction& one = request.transaction;
  if (value >= rank_of(one.response)) one.response = response_names[value];
  if (value == 1 && !request.burst.exclusive)
    report_rule(edge, "ERRS_" + channel + "RESP_EXOKAY", "EXOKAY to a plain access", &one);
}

std::string AxiSide::named(const Request& request) const {
  const auto& address = request.transaction.address;
  return std::string("the ") + operation_ + " of " +
         (address ? hexadecimal(*address) : "an unknown address");
}

void AxiSide::complete(std::size_t place, const SampleEdge& edge) {
  Request& request = open_[place];
  request.transaction.end_ps = edge.ps;
  request.transaction.end_cycle = edge.cycle;
  request.responded = true;
  std::size_t first = place;
  for (std::size_t i = place; i-- > 0;) {
    if (open_[i].responded) continue;
    ++request.transaction.overtakes;
    first = i;
  }
  if (first != place) request.transaction.add_note("overtakes " + named(open_[first]));
}

void AxiSide::erase(std::size_t place) {
  sink_.take(open_[place].ticket, std::move(open_[place].transaction));
  open_.erase(open_.begin() + static_cast<std::ptrdiff_t>(place));
}

void AxiSide::give_up_oldest() {
  open_.front().transaction.add_note("given up: " + std::to_string(most_open) +
                                     " later ones are outstanding");
  erase(0);
}

void AxiSide::add_wanting(const Handshake& channel, const std::string& what, std::uint64_t edges) {
  Wait wait;
  wait.interface = place_;
  wait.state = Wait::State::wants;
  wait.channel = channel.channel();
  wait.for_manager = !channel.by_manager();
  wait.what = channel.channel() + "READY" + (what.empty() ? "" : " for " + what);
  wait.since_ps = channel.offered().ps;
  wait.clocks = edges - channel.offered().cycle;
  wait.idle_since_cycle = channel.ready_low_since();
  waits_.push_back(wait);
}

void AxiSide::add_starved(const Handshake& channel, const std::string& what,
                          const SampleEdge& since, std::uint64_t edges) {
  Wait wait;
  wait.interface = place_;
  wait.state = Wait::State::starved;
  wait.channel = channel.channel();
  wait.for_manager = channel.by_manager();
  wait.what = channel.channel() + "VALID for " + what;
  wait.since_ps = since.ps;
  wait.clocks = edges - since.cycle - 1;
  waits_.push_back(wait);
}

void AxiSide::finish(std::uint64_t /*ps*/, std::uint64_t edges) {
  if (accepting_) {
    Transaction& one = open_.back().transaction;
    one.request_wait = edges - request_.offered().cycle;
    one.add_note("never accepted: " + request_channel_ + "READY low since cycle " +
                 std::to_string(request_.ready_low_since().value_or(0)));
    add_wanting(request_, named(open_.back()), edges);
  }
  add_waits(edges);
  while (!open_.empty()) erase(0);
}

}  // namespace platform::trace
