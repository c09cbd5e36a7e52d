#pragma once

#include <trace/transactions/axi_burst.h>
#include <trace/transactions/handshake.h>

#include <deque>
#include <initializer_list>
#include <string>
#include <vector>

namespace platform::trace {

/// The reads or the writes of AXI4, AXI3 and AXI4-Lite: requests, and what they share. Responses
/// are paired by id, in order of each id.
class AxiSide : public Decoder {
 public:
  /// `request_channel`: "AR" or "AW"; `data_channel`: the one that gives the bus' width.
  AxiSide(const DecoderContext& context, const char* operation, const std::string& request_channel,
          const std::string& data_channel);

  void edge(const SampleEdge& edge) final;
  bool busy() const override { return request_.beat(); }
  void finish(std::uint64_t ps, std::uint64_t edges) final;
  std::vector<Wait> waits() const final { return waits_; }

 protected:
  struct Request {
    Transaction transaction;
    TransactionSink::Ticket ticket = 0;
    AxiBurst burst;
    bool accepted = false;
    bool data_done = false;  ///< all of its data passed
    bool responded = false;
    std::optional<std::uint64_t> write_id;  ///< of AXI3: whose data are its own
    SampleEdge moved;                       ///< its last beat
  };

  /// The other channels, behind the request channel.
  virtual void sample_answers(const SampleEdge& edge) = 0;
  /// A request appeared; its data may be there already.
  virtual void requested(Request& /*request*/, const SampleEdge& /*edge*/) {}
  virtual void forget() = 0;
  /// Adds what waits when the trace is over.
  virtual void add_waits(std::uint64_t edges) = 0;

  Handshake channel(const std::string& name, bool by_manager,
                    std::initializer_list<const char*> payload);
  void sample(Handshake& channel, const SampleEdge& edge) {
    channel.sample(edge, after_reset_, options_.max_wait);
  }
  /// Reports what a channel broke.
  void pass_on(Handshake& channel, Transaction* of);
  void report_rule(const SampleEdge& edge, const std::string& rule, const std::string& detail,
                   Transaction* of) {
    report({prefix_ + rule, edge.ps, edge.cycle, detail}, of);
  }
  /// The worst of the responses so far.
  void note_response(Request& request, const SampleEdge& edge, std::optional<Replay::Slot> code,
                     const std::string& channel);
  /// The last response was accepted.
  void complete(std::size_t place, const SampleEdge& edge);
  void erase(std::size_t place);
  std::string named(const Request& request) const;
  /// A channel that offers a word at the end, and something that does not come.
  void add_wanting(const Handshake& channel, const std::string& what, std::uint64_t edges);
  void add_starved(const Handshake& channel, const std::string& what, const SampleEdge& since,
                   std::uint64_t edges);

  std::string prefix_;  ///< of rules: "AXI4_"
  bool lite_;
  std::deque<Request> open_;  ///< oldest first; the last may not be accepted yet
  bool accepting_ = false;    ///< the last one is offered and not accepted

 private:
  void reset(const SampleEdge& edge);
  void sample_request(const SampleEdge& edge);
  void begin(const SampleEdge& edge);
  void read_burst(Request& request, const SampleEdge& edge);
  void give_up_oldest();

  const char* operation_;
  std::string request_channel_;
  Handshake request_;
  std::optional<Replay::Slot> id_, address_, length_, size_, burst_, lock_, cache_;
  std::uint64_t bus_bytes_ = 4;
  bool was_reset_ = false, after_reset_ = false;
  std::vector<Wait> waits_;
};

}  // namespace platform::trace
