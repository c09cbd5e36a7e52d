#include <sweep/point_message.h>

#include <cstring>
#include <string_view>
#include <type_traits>
#include <utility>

namespace platform::sweep {

namespace {

template <class Number>
void put(std::string& bytes, Number value) {
  static_assert(std::is_arithmetic_v<Number>);
  bytes.append(reinterpret_cast<const char*>(&value), sizeof value);
}

void put_text(std::string& bytes, std::string_view text) {
  put(bytes, std::uint64_t{text.size()});
  bytes += text;
}

/// Takes values off the front of bytes that are all there.
class Taker {
 public:
  explicit Taker(std::string_view bytes) : rest_(bytes) {}

  template <class Number>
  Number take() {
    Number value{};
    std::memcpy(&value, rest_.data(), sizeof value);
    rest_.remove_prefix(sizeof value);
    return value;
  }
  std::string take_text() {
    const auto size = take<std::uint64_t>();
    std::string text(rest_.substr(0, size));
    rest_.remove_prefix(size);
    return text;
  }

 private:
  std::string_view rest_;
};

}  // namespace

std::string MessageWriter::bytes(const PointMessage& message) {
  std::string body;
  put(body, static_cast<std::uint8_t>(message.kind));
  put(body, message.item);
  put(body, message.wall_s);
  put(body, message.cpu_s);
  put(body, message.failed);
  put(body, message.failure.exit_code);
  put(body, message.failure.signal);
  put_text(body, message.failure.message);
  put_text(body, message.row);
  const Metrics& metrics = message.metrics;
  const bool same = metrics.shares_names(before_) || metrics.names() == before_.names();
  put(body, same);
  put(body, std::uint64_t{metrics.values().size()});
  if (!same) {
    for (const std::string& name : metrics.names()) put_text(body, name);
    before_ = metrics;
  }
  for (const double value : metrics.values()) put(body, value);
  std::string bytes;
  put_text(bytes, body);
  return bytes;
}

std::optional<PointMessage> MessageReader::next() {
  std::uint64_t size = 0;
  if (waiting_.size() < sizeof size) return std::nullopt;
  std::memcpy(&size, waiting_.data(), sizeof size);
  if (waiting_.size() < sizeof size + size) return std::nullopt;
  Taker taker(std::string_view(waiting_).substr(sizeof size));
  PointMessage message;
  message.kind = static_cast<PointMessage::Kind>(taker.take<std::uint8_t>());
  message.item = taker.take<std::uint64_t>();
  message.wall_s = taker.take<double>();
  message.cpu_s = taker.take<double>();
  message.failed = taker.take<bool>();
  message.failure.exit_code = taker.take<int>();
  message.failure.signal = taker.take<int>();
  message.failure.message = taker.take_text();
  message.row = taker.take_text();
  const bool same = taker.take<bool>();
  const auto count = taker.take<std::uint64_t>();
  std::shared_ptr<const Metrics::Names> names = before_.shared_names();
  if (!same) {
    auto read = std::make_shared<Metrics::Names>();
    for (std::uint64_t i = 0; i < count; ++i) read->push_back(taker.take_text());
    names = *read == known_.names() ? known_.shared_names() : std::move(read);
  }
  std::vector<double> values;
  values.reserve(count);
  for (std::uint64_t i = 0; i < count; ++i) values.push_back(taker.take<double>());
  message.metrics = Metrics(std::move(names), std::move(values));
  before_ = message.metrics;
  waiting_.erase(0, sizeof size + size);
  return message;
}

}  // namespace platform::sweep
