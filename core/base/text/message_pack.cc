#include "core/base/text/message_pack.h"

#include <cmath>
#include <cstring>

#include "core/base/error.h"
#include "core/base/text/text.h"
#include "core/base/whole_number.h"

namespace graspbench {
namespace {

constexpr int kMostDepth = 16;

[[noreturn]] void FailPacked(const std::string& text) { throw Error(ErrorKind::kFormat, text); }

/** Number type of a numpy dtype: "<f8", "|u1", "|b1". */
struct PackedType {
  char kind;
  size_t size;
};

PackedType ReadPackedType(const std::string& dtype) {
  const bool has_order = dtype.size() == 3 && (dtype[0] == '<' || dtype[0] == '|');
  const char kind = has_order ? dtype[1] : '?';
  const size_t size = has_order ? static_cast<size_t>(dtype[2] - '0') : 0;
  const bool is_float = kind == 'f' && (size == 4 || size == 8);
  const bool is_whole =
      (kind == 'i' || kind == 'u') && (size == 1 || size == 2 || size == 4 || size == 8);
  if (is_float || is_whole || (kind == 'b' && size == 1)) return {kind, size};
  FailPacked("an array of dtype \"" + (IsUtf8(dtype) ? dtype : std::string("?")) +
             "\"; expected little-endian f4, f8, i1 to i8, u1 to u8 or b1");
}

template <class T>
double TakePacked(const char* bytes) {
  T value;
  std::memcpy(&value, bytes, sizeof value);
  return static_cast<double>(value);
}

double ReadPackedNumber(const PackedType& type, const char* bytes) {
  switch (type.kind) {
    case 'f':
      return type.size == 4 ? TakePacked<float>(bytes) : TakePacked<double>(bytes);
    case 'i':
      return type.size == 1   ? TakePacked<int8_t>(bytes)
             : type.size == 2 ? TakePacked<int16_t>(bytes)
             : type.size == 4 ? TakePacked<int32_t>(bytes)
                              : TakePacked<int64_t>(bytes);
    default:
      return type.size == 1   ? TakePacked<uint8_t>(bytes)
             : type.size == 2 ? TakePacked<uint16_t>(bytes)
             : type.size == 4 ? TakePacked<uint32_t>(bytes)
                              : TakePacked<uint64_t>(bytes);
  }
}

std::vector<double> UnpackNumbers(const PackedType& type, const std::string& data) {
  std::vector<double> values(data.size() / type.size);
  for (size_t i = 0; i < values.size(); ++i) {
    values[i] = ReadPackedNumber(type, data.data() + i * type.size);
  }
  return values;
}

/** Makes an array from a map with the keys of a numpy array or scalar. */
PackedArray MakePackedArray(const PackedValue& map, bool is_scalar) {
  const PackedValue* data = map.Find("data");
  const PackedValue* dtype = map.Find("dtype");
  const PackedValue* shape = map.Find("shape");
  if (is_scalar && data) {
    if (const auto* number = std::get_if<double>(&data->value)) return {{}, {*number}};
    if (const auto* truth = std::get_if<bool>(&data->value)) return {{}, {*truth ? 1.0 : 0.0}};
  }
  if (!data || !data->text() || !dtype || !dtype->text() || (!is_scalar && !shape)) {
    FailPacked("an array without data, dtype or shape");
  }
  const PackedType type = ReadPackedType(*dtype->text());
  PackedArray array;
  size_t num_values = 1;
  if (!is_scalar) {
    const auto* sizes = std::get_if<PackedValue::List>(&shape->value);
    if (!sizes) FailPacked("the shape of an array is no list");
    for (const PackedValue& size : *sizes) {
      const double* number = std::get_if<double>(&size.value);
      if (!number || !(*number >= 0.0) || *number > 1e9 || *number != std::floor(*number)) {
        FailPacked("the shape of an array holds something else than sizes");
      }
      array.shape.push_back(ToWhole<size_t>(*number));
      num_values *= array.shape.back();
      if (num_values > data->text()->size()) break;
    }
  }
  if (num_values * type.size != data->text()->size()) {
    FailPacked("an array whose shape does not fit its " + std::to_string(data->text()->size()) +
               " bytes of " + *dtype->text());
  }
  array.values = UnpackNumbers(type, *data->text());
  return array;
}

class PackReader {
 public:
  explicit PackReader(std::string_view bytes) : bytes_(bytes) {}

  PackedValue ReadAll() {
    PackedValue value = Read(0);
    if (at_ != bytes_.size()) Fail("bytes after the value");
    return value;
  }

 private:
  [[noreturn]] void Fail(const std::string& text) const {
    FailPacked("byte " + std::to_string(at_) + ": " + text);
  }

  std::string_view Take(size_t count) {
    if (count > bytes_.size() - at_) Fail("the message ends too early");
    at_ += count;
    return bytes_.substr(at_ - count, count);
  }

  uint64_t TakeUnsigned(size_t size) {
    uint64_t value = 0;
    for (const char byte : Take(size)) value = value << 8 | static_cast<uint8_t>(byte);
    return value;
  }

  double TakeSigned(size_t size) {
    const uint64_t value = TakeUnsigned(size);
    const auto shift = static_cast<unsigned>(64 - 8 * size);
    return static_cast<double>(static_cast<int64_t>(value << shift) >> shift);
  }

  template <class Float, class Bits>
  double TakeFloat() {
    const auto bits = static_cast<Bits>(TakeUnsigned(sizeof(Bits)));
    Float value;
    std::memcpy(&value, &bits, sizeof value);
    return static_cast<double>(value);
  }

  PackedValue TakeText(size_t size) { return {std::string(Take(size))}; }

  PackedValue TakeList(size_t count, int depth) {
    if (count > bytes_.size() - at_) Fail("a list longer than the message");
    PackedValue::List list;
    for (size_t i = 0; i < count; ++i) list.push_back(Read(depth + 1));
    return {std::move(list)};
  }

  PackedValue TakeMap(size_t count, int depth) {
    if (count > bytes_.size() - at_) Fail("a map longer than the message");
    PackedValue::Map map;
    for (size_t i = 0; i < count; ++i) {
      PackedValue key = Read(depth + 1);
      auto* text = std::get_if<std::string>(&key.value);
      if (!text) Fail("the key of a map is neither text nor bytes");
      map.emplace_back(std::move(*text), PackedValue());
      map.back().second = Read(depth + 1);
    }
    PackedValue value = {std::move(map)};
    for (const bool is_scalar : {false, true}) {
      if (!value.Find(is_scalar ? "__npgeneric__" : "__ndarray__")) continue;
      return {MakePackedArray(value, is_scalar)};
    }
    return value;
  }

  PackedValue Read(int depth) {
    if (depth > kMostDepth) Fail("values nested too deeply");
    const auto head = static_cast<uint8_t>(Take(1)[0]);
    if (head < 0x80) return {static_cast<double>(head)};
    if (head < 0x90) return TakeMap(head & 0x0f, depth);
    if (head < 0xa0) return TakeList(head & 0x0f, depth);
    if (head < 0xc0) return TakeText(head & 0x1f);
    if (head >= 0xe0) return {static_cast<double>(static_cast<int8_t>(head))};
    const size_t size = size_t{1} << (head & 3);  // bytes of a number
    switch (head) {
      case 0xc0:
        return {};
      case 0xc2:
      case 0xc3:
        return {head == 0xc3};
      case 0xc4:
      case 0xc5:
      case 0xc6:
        return TakeText(TakeUnsigned(size_t{1} << (head - 0xc4)));
      case 0xca:
        return {TakeFloat<float, uint32_t>()};
      case 0xcb:
        return {TakeFloat<double, uint64_t>()};
      case 0xcc:
      case 0xcd:
      case 0xce:
      case 0xcf:
        return {static_cast<double>(TakeUnsigned(size))};
      case 0xd0:
      case 0xd1:
      case 0xd2:
      case 0xd3:
        return {TakeSigned(size)};
      case 0xd9:
      case 0xda:
      case 0xdb:
        return TakeText(TakeUnsigned(size_t{1} << (head - 0xd9)));
      case 0xdc:
      case 0xdd:
        return TakeList(TakeUnsigned(head == 0xdc ? 2 : 4), depth);
      case 0xde:
      case 0xdf:
        return TakeMap(TakeUnsigned(head == 0xde ? 2 : 4), depth);
      default:
        Fail("an extension type, or no MessagePack");
    }
  }

  std::string_view bytes_;
  size_t at_ = 0;
};

}  // namespace

const PackedValue* PackedValue::Find(std::string_view key) const {
  const auto* map = std::get_if<Map>(&value);
  if (!map) return nullptr;
  for (const auto& [name, item] : *map) {
    if (name == key) return &item;
  }
  return nullptr;
}

template <class T>
void MessagePackWriter::BigEndian(T value) {
  char bytes[sizeof(T)];
  for (size_t i = 0; i < sizeof(T); ++i) {
    bytes[i] = static_cast<char>(value >> (8 * (sizeof(T) - 1 - i)));
  }
  bytes_.append(bytes, sizeof(T));
}

/** @param wide  code of the form with a count of 2 bytes; the next code has a count of 4 bytes. */
void MessagePackWriter::Head(size_t count, uint8_t small, size_t most_small, uint8_t wide) {
  if (count <= most_small) {
    bytes_.push_back(static_cast<char>(small | count));
  } else if (count <= 0xffff) {
    bytes_.push_back(static_cast<char>(wide));
    BigEndian(static_cast<uint16_t>(count));
  } else {
    bytes_.push_back(static_cast<char>(wide + 1));
    BigEndian(static_cast<uint32_t>(count));
  }
}

void MessagePackWriter::Map(size_t num_pairs) { Head(num_pairs, 0x80, 15, 0xde); }
void MessagePackWriter::List(size_t num_items) { Head(num_items, 0x90, 15, 0xdc); }

void MessagePackWriter::Text(std::string_view text) {
  Head(text.size(), 0xa0, 31, 0xda);
  bytes_.append(text);
}

void MessagePackWriter::Bytes(std::string_view bytes) {
  bytes_.push_back(static_cast<char>(0xc6));
  BigEndian(static_cast<uint32_t>(bytes.size()));
  bytes_.append(bytes);
}

void MessagePackWriter::Bool(bool value) {
  bytes_.push_back(static_cast<char>(value ? 0xc3 : 0xc2));
}

void MessagePackWriter::Integer(uint64_t value) {
  bytes_.push_back(static_cast<char>(0xcf));
  BigEndian(value);
}

void MessagePackWriter::Number(double value) {
  uint64_t bits = 0;
  std::memcpy(&bits, &value, sizeof bits);
  bytes_.push_back(static_cast<char>(0xcb));
  BigEndian(bits);
}

void MessagePackWriter::Array(const double* values, const std::vector<size_t>& shape) {
  size_t num_values = 1;
  for (const size_t size : shape) num_values *= size;
  RawArray({reinterpret_cast<const char*>(values), num_values * sizeof(double)}, "<f8", shape);
}

void MessagePackWriter::RawArray(std::string_view data, const char* dtype,
                                 const std::vector<size_t>& shape) {
  Map(4);
  Bytes("__ndarray__");
  Bool(true);
  Bytes("data");
  Bytes(data);
  Bytes("dtype");
  Text(dtype);
  Bytes("shape");
  List(shape.size());
  for (const size_t size : shape) Integer(size);
}

void MessagePackWriter::Value(const PackedValue& value) {
  if (const auto* truth = std::get_if<bool>(&value.value)) return Bool(*truth);
  if (const auto* number = std::get_if<double>(&value.value)) return Number(*number);
  if (const std::string* text = value.text()) return Text(*text);
  if (const auto* array = std::get_if<PackedArray>(&value.value)) {
    return Array(array->values.data(), array->shape);
  }
  if (const auto* list = std::get_if<PackedValue::List>(&value.value)) {
    List(list->size());
    for (const PackedValue& item : *list) Value(item);
    return;
  }
  if (const auto* map = std::get_if<PackedValue::Map>(&value.value)) {
    Map(map->size());
    for (const auto& [key, item] : *map) {
      Text(key);
      Value(item);
    }
    return;
  }
  bytes_.push_back(static_cast<char>(0xc0));
}

void MessagePackWriter::Texts(const std::vector<std::string>& texts) {
  List(texts.size());
  for (const std::string& text : texts) Text(text);
}

PackedValue ParseMessagePack(std::string_view bytes) { return PackReader(bytes).ReadAll(); }

PackedArray ReadPackedArray(const PackedValue& value, const std::string& name) {
  if (const auto* array = std::get_if<PackedArray>(&value.value)) return *array;
  if (const auto* number = std::get_if<double>(&value.value)) return {{}, {*number}};
  const auto* list = std::get_if<PackedValue::List>(&value.value);
  if (!list) FailPacked(name + " is no array of numbers");
  PackedArray array;
  array.shape = {list->size()};
  for (size_t i = 0; i < list->size(); ++i) {
    const PackedArray item = ReadPackedArray((*list)[i], name);
    std::vector<size_t> shape = {list->size()};
    shape.insert(shape.end(), item.shape.begin(), item.shape.end());
    if (i > 0 && shape != array.shape) FailPacked(name + " holds lists of different lengths");
    array.shape = shape;
    array.values.insert(array.values.end(), item.values.begin(), item.values.end());
  }
  return array;
}

}  // namespace graspbench
