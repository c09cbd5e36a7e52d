#include <trace/transactions/lanes.h>

#include <algorithm>
#include <cstdio>
#include <stdexcept>

#include <trace/transactions/record_fields.h>
#include <vp/error.h>
#include <vp/text.h>

namespace platform::trace {

namespace {

/// ps as us, without binary fractions.
std::string exact_us(std::uint64_t ps) {
  constexpr std::uint64_t ps_in_us = 1'000'000;
  char text[32];
  std::snprintf(text, sizeof text, "%llu.%06llu", static_cast<unsigned long long>(ps / ps_in_us),
                static_cast<unsigned long long>(ps % ps_in_us));
  return text;
}

std::string metadata(std::size_t process, std::size_t thread, const char* what,
                     const std::string& name) {
  return R"({"ph":"M","pid":)" + std::to_string(process) + R"(,"tid":)" + std::to_string(thread) +
         R"(,"name":")" + what + R"(","args":{"name":)" + json_text(name) + "}}";
}

}  // namespace

Lanes::Place Lanes::add(const Transaction& one) {
  Place place;
  place.from_ps = std::min(one.begin_ps, one.first_data_ps.value_or(one.begin_ps));
  place.to_ps = std::max(place.from_ps, one.end_ps.value_or(survey_.last_ps));
  // What takes no time is drawn as long as a clock.
  if (place.to_ps == place.from_ps)
    place.to_ps += std::max<std::uint64_t>(1, survey_.interfaces[one.interface].clock_ps);
  auto& free = free_from_[{one.interface, one.operation}];
  const auto found = std::find_if(free.begin(), free.end(),
                                  [&](std::uint64_t from) { return from <= place.from_ps; });
  place.lane = static_cast<std::size_t>(found - free.begin());
  place.is_new = found == free.end();
  if (place.is_new) free.emplace_back();
  free[place.lane] = place.to_ps;
  return place;
}

std::map<Lanes::Group, std::size_t> Lanes::counts() const {
  std::map<Group, std::size_t> counts;
  for (const auto& [group, lanes] : free_from_) counts[group] = lanes.size();
  return counts;
}

std::string Lanes::name(const Group& group, std::size_t lane) const {
  return survey_.interfaces[group.first].bus.name + "." + group.second + "_" +
         std::to_string(lane + 1);
}

std::string lane_text(const Transaction& one) {
  std::vector<std::string> words;
  if (one.address) words.push_back(hexadecimal(*one.address));
  if (one.beats > 1) words.push_back(std::to_string(one.beats) + " beats");
  if (one.beats <= 1 && !one.data.empty()) words.push_back(one.data.front());
  if (*one.response != '\0') words.emplace_back(one.response);
  if (!one.end_ps) words.emplace_back("open");
  for (const Violation& violation : one.violations) words.push_back(violation.rule);
  return words.empty() ? one.operation : vp::join(words, " ");
}

PerfettoLanes::PerfettoLanes(const std::string& file, const Survey& survey)
    : survey_(survey), file_(file), lanes_(survey), ends_(survey.interfaces.size()) {
  file_.write("{\"displayTimeUnit\":\"ns\",\"traceEvents\":[");
  for (std::size_t i = 0; i < survey.interfaces.size(); ++i)
    event(metadata(i + 1, 0, "process_name", survey.interfaces[i].bus.name));
}

void PerfettoLanes::event(const std::string& text) {
  file_.write(any_ ? ",\n" : "\n");
  file_.write(text);
  any_ = true;
}

/// The counter of a bus falls with each end up to now.
void PerfettoLanes::count(std::uint32_t interface, std::uint64_t until_ps) {
  auto& ends = ends_[interface];
  const auto write = [&](std::uint64_t ps) {
    event(R"({"ph":"C","pid":)" + std::to_string(interface + 1) + R"(,"ts":)" + exact_us(ps) +
          R"(,"name":"outstanding","args":{"transactions":)" + std::to_string(ends.size()) + "}}");
  };
  while (!ends.empty() && ends.top() <= until_ps) {
    const std::uint64_t ps = ends.top();
    while (!ends.empty() && ends.top() == ps) ends.pop();
    write(ps);
  }
}

void PerfettoLanes::add(const Transaction& one) {
  const Lanes::Place place = lanes_.add(one);
  auto& threads = threads_[{one.interface, one.operation}];
  const std::string process = std::to_string(one.interface + 1);
  if (place.is_new) {
    threads.push_back(next_thread_++);
    event(metadata(one.interface + 1, threads.back(), "thread_name",
                   std::string(one.operation) + " " + std::to_string(place.lane + 1)));
  }
  count(one.interface, place.from_ps);
  ends_[one.interface].push(place.to_ps);
  event(R"({"ph":"C","pid":)" + process + R"(,"ts":)" + exact_us(place.from_ps) +
        R"(,"name":"outstanding","args":{"transactions":)" +
        std::to_string(ends_[one.interface].size()) + "}}");
  std::string text = R"({"ph":"X","pid":)" + process + R"(,"tid":)" +
                     std::to_string(threads[place.lane]) + R"(,"ts":)" + exact_us(place.from_ps) +
                     R"(,"dur":)" + exact_us(place.to_ps - place.from_ps) + R"(,"name":)" +
                     json_text(lane_text(one)) + R"(,"cat":")" +
                     (one.violations.empty() ? "" : "error") + R"(","args":{)";
  const char* separator = "";
  for (const TransactionField& field : transaction_fields()) {
    const std::string value = field_text(field, one, survey_.interfaces[one.interface]);
    if (value.empty()) continue;
    text += separator + json_text(column_name(field)) + ":" + json_text(value);
    separator = ",";
  }
  event(text + "}}");
}

void PerfettoLanes::close() {
  for (std::uint32_t i = 0; i < ends_.size(); ++i) count(i, survey_.last_ps);
  file_.write("\n]}\n");
  file_.commit();
}

WaveLanes::WaveLanes(const std::string& file, const Survey& survey,
                     const std::map<Lanes::Group, std::size_t>& lanes)
    : survey_(survey), lanes_(survey), writer_(vp::open_wave_writer(file)) {
  std::size_t all = 0;
  for (const auto& [group, count] : lanes) {
    for (std::size_t lane = 0; lane < count; ++lane, ++all) {
      try {
        ids_[group].push_back(
            writer_->add(lanes_.name(group, lane), vp::WaveWriter::Kind::text, 0));
      } catch (const std::invalid_argument& error) {
        throw vp::InputError("lanes in '" + file + "': " + error.what());
      }
    }
  }
  if (all == 0) throw vp::InputError("'" + file + "': there are no transactions to write");
  writer_->begin_written(0, vp::WaveWriter::WrittenValues(all, std::string()));
}

void WaveLanes::write_until(std::uint64_t ps) {
  while (!changes_.empty() && changes_.top().ps < ps) {
    written_ps_ = changes_.top().ps;
    writer_->set_time(written_ps_);
    writer_->change_text(changes_.top().id, changes_.top().text);
    changes_.pop();
  }
}

void WaveLanes::add(const Transaction& one) {
  const Lanes::Place place = lanes_.add(one);
  const auto& ids = ids_[{one.interface, one.operation}];
  write_until(place.from_ps);
  // What came late is drawn from where the file is.
  const std::uint64_t from = std::max(place.from_ps, written_ps_);
  changes_.push({from, order_++, ids[place.lane], lane_text(one)});
  if (one.end_ps) changes_.push({std::max(place.to_ps, from), order_++, ids[place.lane], ""});
}

void WaveLanes::close() {
  write_until(survey_.last_ps + 1);
  writer_->close(std::max(survey_.last_ps, written_ps_));
}

}  // namespace platform::trace
