#include <algorithm>
#include <set>

#include <trace/transactions/axi_side.h>

namespace platform::trace {

namespace {

class AxiReads final : public AxiSide {
 public:
  explicit AxiReads(const DecoderContext& context)
      : AxiSide(context, "read", "AR", "R"),
        response_(channel("R", false, {"ID", "DATA", "RESP", "LAST", "USER"})),
        id_(role("rid")),
        data_(role("rdata")),
        code_(role("rresp")),
        last_(role("rlast")) {}

  bool busy() const override { return AxiSide::busy() || response_.beat(); }

 private:
  void forget() override {
    response_.reset();
    overlong_.clear();
  }

  void sample_answers(const SampleEdge& edge) override {
    sample(response_, edge);
    if (!response_.beat()) {
      pass_on(response_, nullptr);
      return;
    }
    const std::uint64_t id = number(id_).value_or(0);
    const auto found = std::find_if(open_.begin(), open_.end(), [&](const Request& request) {
      return request.accepted && !request.responded && request.transaction.id.value_or(0) == id;
    });
    if (found == open_.end()) {
      pass_on(response_, nullptr);
      unasked(id, edge);
      return;
    }
    beat(static_cast<std::size_t>(found - open_.begin()), id, edge);
  }

  /// A beat that no request has asked for. Behind a burst without LAST it is a late one.
  void unasked(std::uint64_t id, const SampleEdge& edge) {
    if (overlong_.count(id) != 0) {
      if (high(last_)) overlong_.erase(id);
      return;
    }
    report_rule(edge, "ERRS_RID",
                "R of id " + std::to_string(id) + " without a read that is outstanding", nullptr);
  }

  void beat(std::size_t place, std::uint64_t id, const SampleEdge& edge) {
    Request& request = open_[place];
    Transaction& one = request.transaction;
    pass_on(response_, &one);
    if (one.beats_done == 0 && response_.offered().ps <= *one.accepted_ps)
      report_rule(edge, "ERRS_RID", "R is offered before the request has passed", &one);
    const auto [from, behind] = request.burst.lanes(one.beats_done);
    one.bytes += behind > from ? behind - from : 0;
    ++one.beats_done;
    if (!one.first_data_ps) one.first_data_ps = edge.ps;
    one.last_data_ps = edge.ps;
    one.data_wait += response_.waited(edge);
    request.moved = edge;
    if (data_) add_data(one, *data_);
    note_response(request, edge, code_, "R");
    moved(edge, "R of " + named(request));
    check_end(place, id, edge);
  }

  /// LAST ends a burst, or the number of its beats.
  void check_end(std::size_t place, std::uint64_t id, const SampleEdge& edge) {
    Transaction& one = open_[place].transaction;
    const bool all = one.beats_done == one.beats, last = last_ ? high(last_) : all;
    if (last != all && (last || all)) {
      report_rule(edge, "ERRS_RDATA_NUM",
                  last ? "LAST on beat " + std::to_string(one.beats_done) + " of " +
                             std::to_string(one.beats)
                       : "no LAST on the last of " + std::to_string(one.beats) + " beats",
                  &one);
    }
    if (!last && !all) return;
    if (!last) overlong_.insert(id);
    complete(place, edge);
    erase(place);
  }

  void add_waits(std::uint64_t edges) override {
    bool first = true;
    for (Request& request : open_) {
      Transaction& one = request.transaction;
      if (!request.accepted) continue;
      one.add_note(std::to_string(one.beats_done) + " of " + std::to_string(one.beats) +
                   (one.beats == 1 ? " beat" : " beats") + (last_ ? ", no LAST" : "") +
                   ": open at the end");
      if (first && !response_.valid()) add_starved(response_, named(request), request.moved, edges);
      first = false;
    }
    if (response_.valid() && !response_.beat()) add_wanting(response_, "", edges);
  }

  Handshake response_;
  std::optional<Replay::Slot> id_, data_, code_, last_;
  std::set<std::uint64_t> overlong_;  ///< ids whose last burst had no LAST
};

}  // namespace

std::unique_ptr<Decoder> axi_read_decoder(const DecoderContext& context) {
  return std::make_unique<AxiReads>(context);
}

}  // namespace platform::trace
