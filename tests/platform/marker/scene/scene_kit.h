#pragma once

#include <boost/test/unit_test.hpp>

#include <string>

#include <vp/error.h>

namespace scene_kit {

/// Runs `action` and checks that it throws a vp::InputError of one line that contains `part`.
template <typename Action>
void check_refused(Action action, const std::string& part) {
  try {
    action();
    BOOST_ERROR("nothing was refused; expected: " + part);
  } catch (const vp::InputError& error) {
    const std::string message = error.what();
    BOOST_TEST_CONTEXT(message) {
      BOOST_TEST((message.find(part) != std::string::npos));
      BOOST_TEST((message.find('\n') == std::string::npos));
    }
  }
}

}  // namespace scene_kit
