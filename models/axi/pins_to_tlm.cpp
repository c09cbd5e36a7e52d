#include <axi/pins_to_tlm.h>

#include <algorithm>
#include <cstring>
#include <string>
#include <utility>

#include <vp/clock_scheduler.h>
#include <vp/report.h>
#include <vp/text.h>

namespace axi {

namespace {

Response response_of(tlm::tlm_response_status status) {
  if (status == tlm::TLM_OK_RESPONSE) return Response::okay;
  return status == tlm::TLM_ADDRESS_ERROR_RESPONSE ? Response::decerr : Response::slverr;
}

}  // namespace

PinsToTlm::Burst::Burst(const Address& request) : address(request), data(request.bytes()) {
  const unsigned bytes = request.bytes();
  if (request.burst == BurstType::fixed) {
    parts.push_back({request.address, 0, bytes, request.beat_bytes() - request.skew()});
  } else if (request.burst == BurstType::wrap && request.address != request.wrap_base()) {
    const auto first = static_cast<unsigned>(
        request.wrap_base() + request.beats * request.beat_bytes() - request.address);
    parts.push_back({request.address, 0, first, first});
    parts.push_back({request.wrap_base(), first, bytes - first, bytes - first});
  } else {
    parts.push_back({request.address, 0, bytes, bytes});
  }
}

// A beat never belongs to two parts: a WRAP burst begins at a multiple of its size.
Response PinsToTlm::Burst::response_of(unsigned number) const {
  const unsigned last = address.burst == BurstType::fixed
                            ? 0
                            : (number + 1) * address.beat_bytes() - address.skew() - 1;
  for (std::size_t i = 0; i + 1 < parts.size(); ++i) {
    if (last < parts[i].offset + parts[i].bytes) return responses[i];
  }
  return responses.back();
}

PinsToTlm::PinsToTlm(sc_core::sc_module_name name, const vp::Clock& clock, const Shape& shape,
                     Wires& wires)
    : sc_module(name),
      read("read", clock.scheduler()),
      write("write", clock.scheduler()),
      clock_(clock),
      shape_(shape),
      all_lanes_(lanes(0, shape.data_bytes)),
      wires_(wires) {}

void PinsToTlm::sample() {
  if (idle() && wires_.quiet()) return;
  const std::uint64_t cycle = clock_.cycle();
  stalls.add(wires_.stalls());
  if (wires_.b.passes()) writes_.pop_front();
  if (wires_.r.passes()) {
    ++beats;
    Burst& burst = reads_.front();
    if (++burst.beat == burst.address.beats) reads_.pop_front();
  }
  sample_requests(cycle);
  take_write_beats(cycle);
  call_targets();
}

/// AXI4-Lite moves whole words, whatever the lowest bits of the address are (IHI0022 B1.1).
Address PinsToTlm::whole(Address request) const {
  if (shape_.lite) request.address &= ~std::uint64_t{shape_.data_bytes - 1};
  return request;
}

void PinsToTlm::sample_requests(std::uint64_t cycle) {
  if (wires_.aw.passes()) {
    ++bursts;
    requests_.emplace_back(whole(wires_.aw.beat));
    requests_.back().begins = std::max(cycle, write.path().write_free);
  }
  if (wires_.w.passes()) {
    ++beats;
    if (early_.empty() && !requests_.empty())
      take({wires_.w.data, wires_.w.strobes}, cycle);
    else
      early_.push_back({wires_.w.data, wires_.w.strobes});
  }
  if (!wires_.ar.passes()) return;
  ++bursts;
  Burst& burst = reads_.emplace_back(whole(wires_.ar.beat));
  std::uint64_t& bus_free = read.path().read_free;
  burst.begins = std::max(cycle + read_latency, bus_free);
  bus_free = burst.begins + burst.address.beats;
}

void PinsToTlm::take_write_beats(std::uint64_t cycle) {
  while (!requests_.empty() && !early_.empty()) {
    take(early_.front(), cycle);
    early_.pop_front();
  }
}

/// The next beat of the oldest write.
void PinsToTlm::take(const WriteBeat& beat, std::uint64_t cycle) {
  Burst& burst = requests_.front();
  copy(burst, beat);
  if (++burst.beat != burst.address.beats) return;
  const std::uint64_t last = std::max(cycle, burst.begins + burst.address.beats - 1);
  std::uint64_t& bus_free = write.path().write_free;
  bus_free = std::max(bus_free, last + 1);
  burst.ready = last + write_latency;
  writes_.push_back(std::move(burst));
  requests_.pop_front();
}

void PinsToTlm::copy(Burst& burst, const WriteBeat& beat) const {
  const unsigned offset = burst.address.offset(burst.beat);
  const unsigned bytes = burst.address.bytes_in(burst.beat);
  const auto lane =
      static_cast<unsigned>(burst.address.beat_address(burst.beat) & (shape_.data_bytes - 1));
  copy_bytes(&burst.data[offset], &beat.data[lane], bytes);
  if ((beat.strobes & all_lanes_) == all_lanes_) return;
  for (unsigned i = 0; i < bytes; ++i) {
    if (beat.strobes[lane + i]) continue;
    if (burst.enables.empty()) burst.enables.assign(burst.data.size(), TLM_BYTE_ENABLED);
    burst.enables[offset + i] = TLM_BYTE_DISABLED;
  }
}

void PinsToTlm::call_targets() {
  call(reads_, read, tlm::TLM_READ_COMMAND);
  call(writes_, write, tlm::TLM_WRITE_COMMAND);
}

/// One transaction of a direction is at its target at a time.
void PinsToTlm::call(std::deque<Burst>& bursts, xilinx::MemoryPort& port,
                     tlm::tlm_command command) {
  for (Burst& burst : bursts) {
    while (!burst.over()) {
      if (!burst.called) {
        const Part& part = burst.parts[burst.responses.size()];
        unsigned char* enables = burst.enables.empty() ? nullptr : &burst.enables[part.offset];
        port.transfer(command, part.address, &burst.data[part.offset], part.bytes, part.width,
                      enables);
        burst.called = true;
      }
      if (!port.done()) return;
      burst.called = false;
      if (port.response() == tlm::TLM_ADDRESS_ERROR_RESPONSE)
        tell_of_nothing(command, burst.parts[burst.responses.size()].address);
      burst.responses.push_back(axi::response_of(port.response()));
    }
  }
}

/// RTL may ignore its responses.
void PinsToTlm::tell_of_nothing(tlm::tlm_command command, std::uint64_t address) {
  if (std::exchange(told_of_nothing_, true)) return;
  vp::warn(*this, "/markervp/rtl/decode",
           std::string(command == tlm::TLM_READ_COMMAND ? "it reads " : "it writes ") +
               vp::hex(address) +
               ", where nothing answers: the response is DECERR; give the RTL addresses that "
               "its memory has");
}

// What is driven behind an edge passes on the next one at the earliest.
void PinsToTlm::drive() {
  const std::uint64_t next = clock_.cycle() + 1;
  wires_.aw.ready = requests_.size() + writes_.size() < outstanding;
  wires_.w.ready = early_.size() < early_data;
  wires_.ar.ready = reads_.size() < outstanding;
  const bool answers = !writes_.empty() && writes_.front().over() && writes_.front().ready <= next;
  wires_.b.valid = answers;
  if (answers) {
    const Burst& burst = writes_.front();
    wires_.b.id = burst.address.id;
    wires_.b.response = Response::okay;
    for (const Response response : burst.responses)
      wires_.b.response = worst(wires_.b.response, response);
  }
  drive_read(next);
}

void PinsToTlm::drive_read(std::uint64_t next) {
  wires_.r.valid = !reads_.empty() && reads_.front().over() && reads_.front().begins <= next;
  if (!wires_.r.valid) return;
  const Burst& burst = reads_.front();
  wires_.r.id = burst.address.id;
  wires_.r.response = burst.response_of(burst.beat);
  wires_.r.last = burst.beat + 1 == burst.address.beats;
  if (burst.address.bytes_in(burst.beat) != shape_.data_bytes)
    std::fill_n(wires_.r.data.begin(), shape_.data_bytes, static_cast<unsigned char>(0));
  const auto lane =
      static_cast<unsigned>(burst.address.beat_address(burst.beat) & (shape_.data_bytes - 1));
  copy_bytes(&wires_.r.data[lane], &burst.data[burst.address.offset(burst.beat)],
             burst.address.bytes_in(burst.beat));
}

}  // namespace axi
