#pragma once
/** @file
A result, or the reason in words why there is none.

In real studies a statistic may face a single person, no variation or an empty cell. This is a fault
of neither the program nor a file. It is an outcome, which the report prints in place of the number.
So a calculation that may have no result returns Answer<T>, never an invented number. */

#include <optional>
#include <string>
#include <utility>

#include "core/base/error.h"

namespace graspbench {

/** Converts to an Answer of any type: return NoAnswer{"1 person; expected at least 2"}; */
struct NoAnswer {
  std::string reason;
};

template <typename T>
class Answer {
 public:
  Answer() : reason_("not calculated") {}
  Answer(T value) : value_(std::move(value)) {}
  Answer(NoAnswer none) : reason_(std::move(none.reason)) {}

  bool has_value() const { return value_.has_value(); }
  explicit operator bool() const { return has_value(); }
  /** @pre has_value(). */
  const T& operator*() const {
    GRASPBENCH_DEMAND(has_value(), reason_);
    return *value_;
  }
  const T* operator->() const { return &**this; }
  /** Empty if there is a value. */
  const std::string& reason() const { return reason_; }
  /** The reason alone, for a dependent calculation to pass on. */
  NoAnswer none() const { return {reason_}; }

 private:
  std::optional<T> value_;
  std::string reason_;
};

}  // namespace graspbench
