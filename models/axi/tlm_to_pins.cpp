#include <axi/tlm_to_pins.h>

#include <algorithm>
#include <cstring>
#include <string>
#include <utility>

#include <vp/clock_scheduler.h>
#include <vp/error.h>
#include <vp/report.h>
#include <vp/text.h>

namespace axi {

namespace {

unsigned log2_of(unsigned value) {
  unsigned bits = 0;
  while (1u << bits < value) ++bits;
  return bits;
}

}  // namespace

TlmToPins::TlmToPins(sc_core::sc_module_name name, const vp::Clock& clock, const Shape& shape,
                     Wires& wires, Begin begin)
    : sc_module(name),
      socket("socket"),
      clock_(clock),
      shape_(shape),
      all_lanes_(lanes(0, shape.data_bytes)),
      wires_(wires),
      begin_(std::move(begin)) {
  socket.register_b_transport(this, &TlmToPins::b_transport);
  socket.register_get_direct_mem_ptr(this, &TlmToPins::get_direct_mem_ptr);
  drive();
}

bool TlmToPins::get_direct_mem_ptr(tlm::tlm_generic_payload& payload, tlm::tlm_dmi& dmi) {
  dmi.init();
  dmi.set_start_address(payload.get_address());
  dmi.set_end_address(payload.get_address());
  return false;
}

tlm::tlm_response_status TlmToPins::objection(const tlm::tlm_generic_payload& payload) const {
  const bool read = payload.is_read();
  if (!read && !payload.is_write()) return tlm::TLM_COMMAND_ERROR_RESPONSE;
  if (read ? !shape_.reads : !shape_.writes) return tlm::TLM_COMMAND_ERROR_RESPONSE;
  if (payload.get_data_length() == 0 || payload.get_streaming_width() == 0)
    return tlm::TLM_BURST_ERROR_RESPONSE;
  if (payload.get_byte_enable_ptr() && payload.get_byte_enable_length() == 0)
    return tlm::TLM_BYTE_ENABLE_ERROR_RESPONSE;
  return tlm::TLM_OK_RESPONSE;
}

void TlmToPins::b_transport(tlm::tlm_generic_payload& payload, sc_core::sc_time& delay) {
  const tlm::tlm_response_status refused = objection(payload);
  if (refused != tlm::TLM_OK_RESPONSE) return payload.set_response_status(refused);
  check_address(payload);
  vp::ClockScheduler& scheduler = clock_.scheduler();
  scheduler.pass_until(scheduler.now_ps() + vp::to_ps(delay));
  delay = sc_core::SC_ZERO_TIME;
  const std::uint64_t now = scheduler.synchronised_ps();

  Request request{payload};
  for (const Burst& burst : split(request)) {
    ++request.unanswered;
    if (payload.is_read()) {
      ar_.push_back(burst);
      r_.push_back(burst);
    } else {
      aw_.push_back(burst);
      w_.push_back(burst);
      b_.push_back(burst);
    }
  }
  ++open_;
  begin_(clock_.frequency_hz() != 0 && clock_.edge_at_or_after(now) == now);
  wait_for(request);
  payload.set_response_status(request.response == Response::decerr ? tlm::TLM_ADDRESS_ERROR_RESPONSE
                              : request.response == Response::slverr
                                  ? tlm::TLM_GENERIC_ERROR_RESPONSE
                                  : tlm::TLM_OK_RESPONSE);
}

// As on the chip, where the window of a slave may be larger than what it decodes.
void TlmToPins::check_address(const tlm::tlm_generic_payload& payload) {
  const std::uint64_t address = payload.get_address();
  const unsigned bytes = std::min(payload.get_data_length(), payload.get_streaming_width());
  if (warned_ || shape_.beyond(address + (bytes - 1)) == 0) return;
  warned_ = true;
  vp::warn(*this, "/markervp/axi/address_bits",
           std::to_string(bytes) + " bytes from " + vp::hex(address) +
               " of its window: the RTL has " + std::to_string(shape_.address_bits) +
               " address bits and does not see the upper ones, so this is another register or "
               "memory word of it");
}

void TlmToPins::wait_for(Request& request) {
  if (clock_.frequency_hz() == 0) report_hang(request);
  vp::ClockScheduler& scheduler = clock_.scheduler();
  const std::uint64_t cycles = time_limit + request.payload.get_data_length();
  const auto done = [](const void* asked) { return static_cast<const Request*>(asked)->done; };
  scheduler.pass_until(scheduler.now_ps() + clock_.duration_ps(static_cast<double>(cycles)), done,
                       &request);
  if (!request.done) report_hang(request);
}

void TlmToPins::report_hang(const Request& request) const {
  const char* waits_for = !ar_.empty()   ? "ARREADY"
                          : !r_.empty()  ? "RVALID"
                          : !aw_.empty() ? "AWREADY"
                          : !w_.empty()  ? "WREADY"
                                         : "BVALID";
  throw vp::ProtocolError(
      std::string("bus hang: ") + (request.payload.is_read() ? "read of " : "write to ") +
      vp::hex(request.payload.get_address()) + " at " + name() + " waits for " + waits_for +
      (clock_.frequency_hz() == 0
           ? std::string(", and ") + clock_.name() + " is stopped"
           : " for more than " + std::to_string(time_limit.get()) + " cycles of " + clock_.name() +
                 " (" + time_limit.name() + "): is the RTL in reset?"));
}

std::vector<TlmToPins::Burst> TlmToPins::split(Request& request) const {
  std::vector<Burst> bursts;
  const unsigned length = request.payload.get_data_length();
  const unsigned width = request.payload.get_streaming_width();
  const std::uint64_t address = request.payload.get_address();
  if (width >= length) {
    add_linear(bursts, request, 0, length);
  } else if (!shape_.lite && power_of_two(width) && width <= shape_.data_bytes &&
             address % width == 0 && length % width == 0) {
    add_fixed(bursts, request);
  } else {
    for (unsigned at = 0; at < length; at += width)
      add_linear(bursts, request, at, std::min(width, length - at));
  }
  return bursts;
}

/// Bytes from `offset` of the payload on, to its address.
void TlmToPins::add_linear(std::vector<Burst>& bursts, Request& request, unsigned offset,
                           unsigned bytes) const {
  const unsigned word = shape_.data_bytes;
  std::uint64_t address = request.payload.get_address();
  while (bytes != 0) {
    Burst burst{{}, offset, bytes, &request};
    const auto skew = static_cast<unsigned>(address % word);
    const bool narrow =
        !shape_.lite && skew + bytes <= word && power_of_two(bytes) && address % bytes == 0;
    burst.address.address = address;
    burst.address.size = log2_of(narrow ? bytes : word);
    if (!narrow) {
      const auto to_boundary = static_cast<unsigned>(boundary - address % boundary);
      burst.bytes = std::min({bytes, to_boundary, shape_.burst_beats * word - skew});
      burst.address.beats = (skew + burst.bytes + word - 1) / word;
    }
    address += burst.bytes;
    offset += burst.bytes;
    bytes -= burst.bytes;
    bursts.push_back(burst);
  }
}

void TlmToPins::add_fixed(std::vector<Burst>& bursts, Request& request) const {
  constexpr unsigned most_fixed_beats = 16;
  const unsigned length = request.payload.get_data_length();
  const unsigned width = request.payload.get_streaming_width();
  const unsigned most = std::min(most_fixed_beats, shape_.burst_beats) * width;
  for (unsigned at = 0; at < length; at += most) {
    Burst burst{{}, at, std::min(most, length - at), &request};
    burst.address.address = request.payload.get_address();
    burst.address.size = log2_of(width);
    burst.address.beats = burst.bytes / width;
    burst.address.burst = BurstType::fixed;
    bursts.push_back(burst);
  }
}

TlmToPins::Span TlmToPins::span(const Burst& burst, unsigned beat) const {
  const Address& a = burst.address;
  const unsigned begin = a.offset(beat);
  return {static_cast<unsigned>(a.beat_address(beat)) & (shape_.data_bytes - 1),
          burst.offset + begin, std::min(a.bytes_in(beat), burst.bytes - begin)};
}

void TlmToPins::answer(const Burst& burst, Response response) {
  Request& request = *burst.request;
  request.response = worst(request.response, response);
  if (--request.unanswered != 0) return;
  request.done = true;
  --open_;
  clock_.scheduler().check_condition();
}

void TlmToPins::sample() {
  if (idle()) return;
  stalls.add(wires_.stalls());
  sample_writes();
  sample_reads();
}

void TlmToPins::sample_writes() {
  if (wires_.aw.passes()) {
    aw_.pop_front();
    ++bursts;
  }
  if (wires_.w.passes()) {
    ++beats;
    if (++w_beat_ == w_.front().address.beats) {
      w_.pop_front();
      w_beat_ = 0;
    }
  }
  // A response that comes before its burst has passed is the checker's to report.
  if (wires_.b.passes() && b_.size() > std::max(aw_.size(), w_.size())) {
    const Burst burst = b_.front();
    b_.pop_front();
    answer(burst, wires_.b.response);
  }
}

void TlmToPins::sample_reads() {
  if (wires_.ar.passes()) {
    ar_.pop_front();
    ++bursts;
  }
  if (!wires_.r.passes() || r_.size() <= ar_.size()) return;
  ++beats;
  const Burst burst = r_.front();
  const Span part = span(burst, r_beat_);
  tlm::tlm_generic_payload& payload = burst.request->payload;
  const unsigned char* enables = payload.get_byte_enable_ptr();
  if (!enables)
    copy_bytes(payload.get_data_ptr() + part.offset, &wires_.r.data[part.lane], part.bytes);
  for (unsigned i = 0; enables && i < part.bytes; ++i) {
    const unsigned at = part.offset + i;
    if (enables[at % payload.get_byte_enable_length()] == TLM_BYTE_ENABLED)
      payload.get_data_ptr()[at] = wires_.r.data[part.lane + i];
  }
  burst.request->response = worst(burst.request->response, wires_.r.response);
  if (++r_beat_ != burst.address.beats) return;
  r_beat_ = 0;
  r_.pop_front();
  answer(burst, wires_.r.response);
}

void TlmToPins::drive() {
  wires_.aw.valid = !aw_.empty();
  if (wires_.aw.valid) wires_.aw.beat = aw_.front().address;
  wires_.ar.valid = !ar_.empty();
  if (wires_.ar.valid) wires_.ar.beat = ar_.front().address;
  wires_.w.valid = !w_.empty();
  if (wires_.w.valid) drive_data();
  wires_.b.ready = wires_.r.ready = true;
}

void TlmToPins::drive_data() {
  const Burst& burst = w_.front();
  const Span part = span(burst, w_beat_);
  const tlm::tlm_generic_payload& payload = burst.request->payload;
  const unsigned char* enables = payload.get_byte_enable_ptr();
  if (part.bytes != shape_.data_bytes)
    std::fill_n(wires_.w.data.begin(), shape_.data_bytes, static_cast<unsigned char>(0));
  copy_bytes(&wires_.w.data[part.lane], payload.get_data_ptr() + part.offset, part.bytes);
  wires_.w.strobes = part.bytes == shape_.data_bytes ? all_lanes_ : lanes(part.lane, part.bytes);
  for (unsigned i = 0; enables && i < part.bytes; ++i) {
    if (enables[(part.offset + i) % payload.get_byte_enable_length()] != TLM_BYTE_ENABLED)
      wires_.w.strobes.reset(part.lane + i);
  }
  wires_.w.last = w_beat_ + 1 == burst.address.beats;
}

}  // namespace axi
