#include "datasets/grasps/python_values.h"

#include <fmt/core.h>

#include <cmath>
#include <cstring>

#include "core/base/error.h"

namespace graspbench {
namespace {

using Kind = PickleValue::Kind;

uint64_t ReadBits(const PickleValue& array, int64_t index) {
  const auto* bytes = reinterpret_cast<const uint8_t*>(array.data->text.data()) +
                      static_cast<size_t>(index * array.element_size);
  uint64_t bits = 0;
  for (int64_t i = 0; i < array.element_size; ++i) {
    bits = bits << 8 | bytes[array.is_big_endian ? i : array.element_size - 1 - i];
  }
  return bits;
}

/** IEEE 754 binary16. */
double FromHalf(uint64_t bits) {
  const int exponent = static_cast<int>(bits >> 10 & 31);
  const double fraction = static_cast<double>(bits & 1023) / 1024.0;
  const double size = exponent == 31  ? (fraction == 0.0 ? HUGE_VAL : std::nan(""))
                      : exponent == 0 ? std::ldexp(fraction, -14)
                                      : std::ldexp(1.0 + fraction, exponent - 15);
  return bits >> 15 & 1 ? -size : size;
}

double ReadElement(const PickleValue& array, int64_t index) {
  const uint64_t bits = ReadBits(array, index);
  const int shift = static_cast<int>(64 - 8 * array.element_size);
  if (array.type == 'i') return static_cast<double>(static_cast<int64_t>(bits << shift) >> shift);
  if (array.type == 'u') return static_cast<double>(bits);
  if (array.type == 'b') return bits != 0 ? 1.0 : 0.0;
  if (array.element_size == 2) return FromHalf(bits);
  if (array.element_size == 4) {
    const auto low = static_cast<uint32_t>(bits);
    float value = 0.0f;
    std::memcpy(&value, &low, sizeof value);
    return value;
  }
  double value = 0.0;
  std::memcpy(&value, &bits, sizeof value);
  return value;
}

bool HasNumbers(const PickleValue& value) {
  return value.kind == Kind::kArray &&
         std::string_view("fiub").find(value.type) != std::string::npos;
}

bool IsScalar(const PickleValue& value) {
  return value.kind == Kind::kNumber || value.kind == Kind::kInteger || value.kind == Kind::kBool ||
         (HasNumbers(value) && value.shape.empty());
}

double ReadScalar(const PickleValue& value) {
  return value.kind == Kind::kArray ? ReadElement(value, 0) : value.number;
}

/** Whose items stand in `items`. */
bool IsList(const PickleValue& value) {
  return value.kind == Kind::kList || value.kind == Kind::kTuple ||
         (value.kind == Kind::kArray && value.type == 'O' && value.shape.size() == 1);
}

[[noreturn]] void FailNumbers(const PickleValue& value, const std::string& where) {
  throw Error(ErrorKind::kFormat, where + " is " + DescribeValue(value) +
                                      ", expected numbers in at most two dimensions");
}

NumberTable ReadArray(const PickleValue& array) {
  NumberTable table;
  table.num_dimensions = static_cast<int>(array.shape.size());
  table.num_columns = array.shape.empty() ? 1 : array.shape.back();
  table.num_rows = array.shape.size() == 2 ? array.shape.front() : 1;
  table.numbers.reserve(static_cast<size_t>(table.num_rows * table.num_columns));
  for (int64_t row = 0; row < table.num_rows; ++row) {
    for (int64_t column = 0; column < table.num_columns; ++column) {
      table.numbers.push_back(ReadElement(array, array.is_fortran_order
                                                     ? column * table.num_rows + row
                                                     : row * table.num_columns + column));
    }
  }
  return table;
}

/** Puts the numbers of a row behind those of the table. A file may name one array many times, so
that its own size is no bound. */
void AppendRow(const PickleValue& row, const std::string& where, NumberTable& table) {
  constexpr size_t kMaxNumbers = 16'000'000;
  const size_t before = table.numbers.size();
  const bool is_array = HasNumbers(row) && row.shape.size() == 1;
  const size_t count = is_array ? static_cast<size_t>(row.shape.front()) : row.items.size();
  if (count > kMaxNumbers - before) {
    throw Error(ErrorKind::kFormat, fmt::format("{} is a list of more than {} numbers; expected an "
                                                "array, or fewer grasps in one file",
                                                where, kMaxNumbers));
  }
  if (is_array) {
    const NumberTable inner = ReadArray(row);
    table.numbers.insert(table.numbers.end(), inner.numbers.begin(), inner.numbers.end());
  } else if (IsList(row)) {
    for (const PickleValue* item : row.items) {
      if (!IsScalar(Unwrap(*item))) FailNumbers(Unwrap(*item), where);
      table.numbers.push_back(ReadScalar(Unwrap(*item)));
    }
  } else {
    FailNumbers(row, where);
  }
  const auto columns = static_cast<int64_t>(table.numbers.size() - before);
  if (table.num_rows > 0 && columns != table.num_columns) {
    throw Error(ErrorKind::kFormat, fmt::format("{} has rows of {} and of {} numbers", where,
                                                table.num_columns, columns));
  }
  table.num_columns = columns;
  ++table.num_rows;
}

NumberTable ReadList(const PickleValue& list, const std::string& where) {
  NumberTable table;
  if (list.items.empty() || IsScalar(Unwrap(*list.items.front()))) {
    table.num_dimensions = 1;
    AppendRow(list, where, table);
  } else {
    table.num_dimensions = 2;
    for (const PickleValue* row : list.items) AppendRow(Unwrap(*row), where, table);
  }
  return table;
}

void AppendUtf8(char32_t point, std::string& text) {
  const auto put = [&](char32_t bits) { text.push_back(static_cast<char>(bits)); };
  if (point < 0x80) {
    put(point);
  } else if (point < 0x800) {
    put(0xc0 | point >> 6);
    put(0x80 | (point & 63));
  } else if (point < 0x10000) {
    put(0xe0 | point >> 12);
    put(0x80 | (point >> 6 & 63));
    put(0x80 | (point & 63));
  } else {
    put(0xf0 | point >> 18);
    put(0x80 | (point >> 12 & 63));
    put(0x80 | (point >> 6 & 63));
    put(0x80 | (point & 63));
  }
}

/** UTF-32 as numpy keeps texts: filled up with zeros. */
std::string FromUtf32(const PickleValue& array, const std::string& where) {
  PickleValue letters = array;
  letters.element_size = 4;
  std::string text;
  for (int64_t i = 0; i < array.element_size / 4; ++i) {
    const uint64_t point = ReadBits(letters, i);
    if (point == 0) break;
    if (point > 0x10ffff) throw Error(ErrorKind::kFormat, where + " is no text: damaged");
    AppendUtf8(static_cast<char32_t>(point), text);
  }
  return text;
}

}  // namespace

Pickle ReadNpy(std::string_view bytes, const std::string& file) {
  constexpr std::string_view kMagic = "\x93NUMPY";
  if (bytes.empty()) throw Error(ErrorKind::kFormat, file + " is empty; expected a .npy file");
  if (bytes.front() == '\x80') return ReadPickle(bytes, file);
  if (bytes.substr(0, kMagic.size()) != kMagic || bytes.size() < 12) {
    throw Error(ErrorKind::kFormat,
                file + ": byte 0: neither a .npy file nor a pickle; expected what np.save writes");
  }
  const bool is_short = bytes[6] == 1;
  const auto byte = [&](size_t at) { return static_cast<size_t>(static_cast<uint8_t>(bytes[at])); };
  const size_t start = is_short ? 10 : 12;
  const size_t length =
      is_short ? byte(8) | byte(9) << 8 : byte(8) | byte(9) << 8 | byte(10) << 16 | byte(11) << 24;
  if (length > bytes.size() - start) {
    throw Error(ErrorKind::kFormat,
                fmt::format("{}: byte 8: a header of {} bytes, {} are left; the file is truncated "
                            "or damaged",
                            file, length, bytes.size() - start));
  }
  const std::string_view header = bytes.substr(start, length);
  if (header.find("'|O'") == std::string_view::npos &&
      header.find("'O'") == std::string_view::npos) {
    throw Error(ErrorKind::kFormat,
                file + ": byte " + std::to_string(start) +
                    ": an array of plain numbers; expected a dictionary saved by np.save (type "
                    "'|O')");
  }
  Pickle pickle = ReadPickle(bytes.substr(start + length), file, start + length);
  if (pickle.root->kind != Kind::kArray || pickle.root->type != 'O') {
    throw Error(ErrorKind::kFormat, file + " is announced as an array of objects and holds " +
                                        DescribeValue(*pickle.root));
  }
  return pickle;
}

const PickleValue& Unwrap(const PickleValue& value) {
  return value.kind == Kind::kArray && value.type == 'O' && value.shape.empty() ? *value.items[0]
                                                                                : value;
}

const PickleValue* FindItem(const PickleValue& dict, std::string_view key) {
  if (dict.kind != Kind::kDict) return nullptr;
  for (size_t i = dict.items.size(); i >= 2; i -= 2) {
    const PickleValue& found = *dict.items[i - 2];
    if (found.kind == Kind::kText && found.text == key) return dict.items[i - 1];
  }
  return nullptr;
}

NumberTable ReadNumbers(const PickleValue& wrapped, const std::string& where) {
  const PickleValue& value = Unwrap(wrapped);
  NumberTable table;
  if (HasNumbers(value) && value.shape.size() <= 2) {
    // The file pays for every number, but not for rows without any.
    if (value.shape.size() == 2 && value.shape.front() > 0 && value.shape.back() == 0) {
      throw Error(ErrorKind::kFormat, where + " is " + DescribeValue(value) +
                                          ", expected at least one number in each row");
    }
    table = ReadArray(value);
  } else if (IsScalar(value)) {
    table = {1, 1, 0, {ReadScalar(value)}};
  } else if (IsList(value)) {
    table = ReadList(value, where);
  } else {
    FailNumbers(value, where);
  }
  for (size_t i = 0; i < table.numbers.size(); ++i) {
    if (!std::isfinite(table.numbers[i])) {
      throw Error(ErrorKind::kFormat, fmt::format("{}: number {} is not finite", where, i + 1));
    }
  }
  return table;
}

double ReadNumber(const PickleValue& value, const std::string& where) {
  const NumberTable table = ReadNumbers(value, where);
  if (table.numbers.size() != 1) {
    throw Error(ErrorKind::kFormat,
                where + " is " + DescribeValue(Unwrap(value)) + ", expected one number");
  }
  return table.numbers.front();
}

std::string ReadText(const PickleValue& wrapped, const std::string& where) {
  const PickleValue& value = Unwrap(wrapped);
  const bool is_array = value.kind == Kind::kArray && value.type == 'U' && value.shape.empty();
  if (value.kind != Kind::kText && !is_array) {
    throw Error(ErrorKind::kFormat, where + " is " + DescribeValue(value) + ", expected a text");
  }
  return value.kind == Kind::kText ? value.text : FromUtf32(value, where);
}

std::string DescribeValue(const PickleValue& value) {
  static constexpr const char* kWords[] = {"None",
                                           "a truth value",
                                           "a number",
                                           "a number",
                                           "a text",
                                           "bytes",
                                           "a list",
                                           "a tuple",
                                           "a dictionary",
                                           "an array of numpy",
                                           "a type of numpy",
                                           "a function of numpy"};  // by kind
  const std::string word = kWords[static_cast<size_t>(value.kind)];
  if (value.kind != Kind::kArray) return word;
  std::string shape;
  for (const int64_t size : value.shape) {
    shape += (shape.empty() ? "" : " x ") + std::to_string(size);
  }
  return fmt::format("{} (type {}{}{})", word, value.type, shape.empty() ? "" : ", ", shape);
}

}  // namespace graspbench
