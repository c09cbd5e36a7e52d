#pragma once

#include <vp/error.h>

#include <string>

/// The message of the vp::InputError that `action` throws; "nothing thrown" if none.
template <class Action>
std::string input_error(Action&& action) {
  try {
    action();
  } catch (const vp::InputError& error) {
    return error.what();
  }
  return "nothing thrown";
}
