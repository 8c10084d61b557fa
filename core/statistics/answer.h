#pragma once
/** @file
A result, or the reason in words why there is none.

Statistics of real studies meet one person, no spread, an empty cell. That is neither a fault of the
program nor of a file: it is an outcome, and the report prints it where the number would stand. So a
calculation that can have no result returns Answer<T>; it never returns a number made up for the
occasion. */

#include <optional>
#include <string>
#include <utility>

#include "core/base/error.h"

namespace graspbench {

/** Turns into an Answer of any type: return NoAnswer{"1 person; expected at least 2"}; */
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
  /** Empty when there is a value. */
  const std::string& reason() const { return reason_; }
  /** The reason alone, to be passed on by a calculation that needed this one. */
  NoAnswer none() const { return {reason_}; }

 private:
  std::optional<T> value_;
  std::string reason_;
};

}  // namespace graspbench
