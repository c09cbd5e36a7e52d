#pragma once

#include <boost/test/unit_test.hpp>
#include <string>

#include <vp/error.h>

namespace sweep_test {

/// What `work` complains about; empty if it does not.
template <class Work>
std::string complaint(const Work& work) {
  try {
    work();
  } catch (const vp::InputError& error) {
    return error.what();
  }
  return "";
}

inline bool contains(const std::string& text, const std::string& part) {
  return text.find(part) != std::string::npos;
}

}  // namespace sweep_test
