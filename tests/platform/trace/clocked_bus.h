#pragma once

#include <trace/transactions/summary.h>
#include <trace/transactions/transactions.h>

#include <map>
#include <string>
#include <utility>
#include <vector>

#include "waves.h"

/// Signals of a bus by clock: values are given for the edge that samples them. The clock `top.clk`
/// rises at 5, 15, 25 … ns; signals change 1 ns behind an edge.
class ClockedBus {
 public:
  using Script = std::map<std::pair<unsigned, std::string>, std::string>;

  /// `signals`: "awvalid 1, awaddr 32", all below `scope`, 0 at first.
  ClockedBus(std::string signals, Script script, unsigned clocks, std::string scope = "top.")
      : signals_(std::move(signals)),
        scope_(std::move(scope)),
        script_(std::move(script)),
        clocks_(clocks) {}

  std::string declarations() const {
    std::string text = "top.clk 1";
    for (const auto& [name, width] : names()) text += ", " + scope_ + name + " " + width;
    return text;
  }
  std::string changes() const {
    std::string text = "#0\n0!\n";
    char code = '"';
    std::map<std::string, std::string> codes;
    for (const auto& [name, width] : names()) {
      codes[name] = (width == "1" ? "" : " ") + std::string(1, code++);
      text += value("0", codes[name]);
    }
    for (unsigned clock = 0; clock < clocks_; ++clock) {
      if (clock > 0) text += "#" + std::to_string(clock * 10 - 4) + "\n";
      for (const auto& [key, digits] : script_) {
        if (key.first == clock) text += value(digits, codes.at(key.second));
      }
      if (clock > 0) text += "#" + std::to_string(clock * 10) + "\n0!\n";
      text += "#" + std::to_string(clock * 10 + 5) + "\n1!\n";
    }
    return text;
  }

 private:
  static std::string value(const std::string& digits, const std::string& code) {
    return (code[0] == ' ' ? "b" : "") + digits + code + "\n";
  }
  std::vector<std::pair<std::string, std::string>> names() const {
    std::vector<std::pair<std::string, std::string>> names;
    for (std::size_t at = 0; at < signals_.size();) {
      const std::size_t end = std::min(signals_.find(", ", at), signals_.size());
      const std::string one = signals_.substr(at, end - at);
      names.emplace_back(one.substr(0, one.find(' ')), one.substr(one.find(' ') + 1));
      at = end + 2;
    }
    return names;
  }

  std::string signals_, scope_;
  Script script_;
  unsigned clocks_;
};

/// What was found in a trace.
struct FoundTransactions {
  platform::trace::Survey survey;
  std::vector<platform::trace::Transaction> all;
  platform::trace::TransactionsEnd end;

  /// "AXI4_ERRM_AWADDR_STABLE ": rules, each once.
  std::string rules() const {
    std::string text;
    for (const auto& rule : end.broken) text += rule.rule + " ";
    return text;
  }
  /// "tb.m_axi ".
  std::string interfaces() const {
    std::string text;
    for (const auto& one : survey.interfaces)
      text += one.bus.name + ":" + platform::trace::bus_kind_name(one.bus.kind) + " ";
    return text;
  }
};

inline FoundTransactions transactions_of(const std::string& declarations,
                                         const std::string& changes,
                                         const platform::trace::TransactionsOptions& options = {}) {
  const Waves waves(declarations, changes);
  FoundTransactions found;
  platform::trace::TraceFile first(waves.file), second(waves.file);
  found.survey = platform::trace::survey_transactions(first, options);
  constexpr std::uint64_t hang_clocks = 10;
  found.end = platform::trace::read_transactions(
      second, found.survey, options, hang_clocks,
      [&](const platform::trace::Transaction& one) { found.all.push_back(one); });
  return found;
}

inline FoundTransactions transactions_of(const ClockedBus& bus,
                                         const platform::trace::TransactionsOptions& options = {}) {
  return transactions_of(bus.declarations(), bus.changes(), options);
}

/// "read 0x200 125-185 OKAY": operation, address, begin and end in ns, response.
inline std::string brief(const platform::trace::Transaction& one) {
  std::string text = one.operation;
  if (one.address) text += " " + platform::trace::hexadecimal(*one.address);
  text += " " + std::to_string(one.begin_ps / 1000) + "-" +
          (one.end_ps ? std::to_string(*one.end_ps / 1000) : "");
  return text + (*one.response == '\0' ? "" : " ") + one.response;
}
