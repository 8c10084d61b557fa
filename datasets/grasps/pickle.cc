#include "datasets/grasps/pickle.h"

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <cstring>
#include <map>

#include "core/base/error.h"
#include "core/base/text/text.h"
#include "core/base/whole_number.h"

namespace graspbench {
namespace {

using Kind = PickleValue::Kind;

constexpr int kMaxDepth = 32;
constexpr size_t kMaxValues = 4'000'000;
constexpr uint64_t kHighestProtocol = 5;

const std::array<const char*, 9> kAllowedNames = {"numpy.core.multiarray _reconstruct",
                                                  "numpy._core.multiarray _reconstruct",
                                                  "numpy.core.multiarray scalar",
                                                  "numpy._core.multiarray scalar",
                                                  "numpy.core.numeric _frombuffer",
                                                  "numpy._core.numeric _frombuffer",
                                                  "numpy ndarray",
                                                  "numpy dtype",
                                                  "_codecs encode"};

/** One pass over the operations. Its marks are null pointers on the stack. */
class PickleMachine {
 public:
  PickleMachine(std::string_view bytes, const std::string& file, size_t first_byte)
      : bytes_(bytes), file_(file), first_byte_(first_byte) {}

  Pickle Run() {
    for (;;) {
      operation_at_ = at_;
      const auto operation = static_cast<uint8_t>(TakeLittle(1));
      if (operation == '.') break;
      Execute(operation);
    }
    pickle_.root = Pop();
    if (!stack_.empty()) Fail("the pickle ends with values left over: damaged");
    return std::move(pickle_);
  }

 private:
  [[noreturn]] void Fail(const std::string& what) const {
    throw Error(ErrorKind::kFormat,
                fmt::format("{}: byte {}: {}", file_, first_byte_ + operation_at_, what));
  }

  std::string_view Take(uint64_t count) {
    if (count > bytes_.size() - at_) {
      Fail(fmt::format(
          "{} announced, {} left; the file is truncated or damaged",
          FormatCount(static_cast<int64_t>(std::min<uint64_t>(count, INT64_MAX)), "byte", "bytes"),
          bytes_.size() - at_));
    }
    const std::string_view taken = bytes_.substr(at_, count);
    at_ += count;
    return taken;
  }
  uint64_t TakeLittle(size_t count) {
    uint64_t value = 0;
    const std::string_view taken = Take(count);
    for (size_t i = count; i-- > 0;) value = value << 8 | static_cast<uint8_t>(taken[i]);
    return value;
  }
  std::string_view TakeLine() {
    const size_t end = bytes_.find('\n', at_);
    if (end == std::string_view::npos) Fail("a line without end; the file is truncated or damaged");
    const std::string_view line = bytes_.substr(at_, end - at_);
    at_ = end + 1;
    return line;
  }

  PickleValue& New(Kind kind) {
    if (pickle_.values.size() >= kMaxValues) {
      Fail(fmt::format("more than {} values; that is no grasp file", kMaxValues));
    }
    pickle_.values.emplace_back().kind = kind;
    return pickle_.values.back();
  }
  PickleValue& Push(Kind kind) {
    PickleValue& value = New(kind);
    stack_.push_back(&value);
    return value;
  }
  void PushEmpty(Kind kind) { Push(kind); }
  void PushNumber(Kind kind, double number) { Push(kind).number = number; }
  void PushText(Kind kind, std::string_view text) {
    if (kind == Kind::kText && !IsUtf8(text)) Fail("a text that is not UTF-8");
    Push(kind).text = std::string(text);
  }

  PickleValue* Pop() {
    if (stack_.empty() || !stack_.back()) Fail("an operation without its values: damaged");
    PickleValue* value = stack_.back();
    stack_.pop_back();
    return value;
  }
  PickleValue* Top(Kind kind, const char* what) {
    if (stack_.empty() || !stack_.back() || stack_.back()->kind != kind) {
      Fail(fmt::format("expected {} below: damaged", what));
    }
    return stack_.back();
  }
  std::vector<PickleValue*> PopToMark() {
    size_t mark = stack_.size();
    while (mark > 0 && stack_[mark - 1]) --mark;
    if (mark == 0) Fail("an operation without its mark: damaged");
    std::vector<PickleValue*> values(stack_.begin() + static_cast<std::ptrdiff_t>(mark),
                                     stack_.end());
    stack_.resize(mark - 1);
    return values;
  }
  void PutInto(PickleValue& outer, const PickleValue* inner) {
    outer.items.push_back(inner);
    outer.depth = std::max(outer.depth, inner->depth + 1);
    if (outer.depth > kMaxDepth) {
      Fail(fmt::format("more than {} values inside each other; a grasp file has fewer", kMaxDepth));
    }
  }
  void PutAllInto(PickleValue& outer, const std::vector<PickleValue*>& values) {
    for (const PickleValue* value : values) PutInto(outer, value);
  }
  void AppendToList(const std::vector<PickleValue*>& values) {
    PutAllInto(*Top(Kind::kList, "a list"), values);
  }
  void AppendToDict(const std::vector<PickleValue*>& values) {
    PickleValue& dict = *Top(Kind::kDict, "a dictionary");
    if (values.size() % 2 != 0) Fail("a key without its value: damaged");
    PutAllInto(dict, values);
  }
  std::vector<PickleValue*> PopValues(size_t count) {
    std::vector<PickleValue*> values(count);
    for (size_t i = count; i-- > 0;) values[i] = Pop();
    return values;
  }
  void PushTuple(const std::vector<PickleValue*>& values) {
    PutAllInto(Push(Kind::kTuple), values);
  }

  void Memoize(uint64_t index) {
    if (stack_.empty() || !stack_.back()) Fail("nothing to remember: damaged");
    memo_[index] = stack_.back();
  }
  void Recall(uint64_t index) {
    const auto found = memo_.find(index);
    if (found == memo_.end()) Fail(fmt::format("value {} was never remembered: damaged", index));
    stack_.push_back(found->second);
  }

  void PushName(const std::string& module_name, const std::string& name) {
    const std::string full = module_name + " " + name;
    if (std::find(kAllowedNames.begin(), kAllowedNames.end(), full) == kAllowedNames.end()) {
      Fail(
          fmt::format("the pickle names {}.{}, which is neither a plain value nor an array of "
                      "numpy; it was not executed. Save the grasps as a dictionary of numpy "
                      "arrays, numbers and texts",
                      EscapeForTerminal(module_name), EscapeForTerminal(name)));
    }
    Push(Kind::kName).text = full.substr(full.rfind(' ') + 1);
  }

  void PushLong(uint64_t count) {
    const std::string_view little = Take(count);
    if (count > 8) Fail(fmt::format("a whole number of {} bytes; at most 8 are read", count));
    uint64_t bits = count > 0 && static_cast<int8_t>(little.back()) < 0 ? ~uint64_t{0} : 0;
    for (size_t i = count; i-- > 0;) bits = bits << 8 | static_cast<uint8_t>(little[i]);
    PushNumber(Kind::kInteger, static_cast<double>(static_cast<int64_t>(bits)));
  }

  // --- What numpy's names mean -------------------------------------------------------------------

  const PickleValue* Argument(const PickleValue& arguments, size_t index, Kind kind) const {
    if (index >= arguments.items.size() || arguments.items[index]->kind != kind) {
      Fail(fmt::format("argument {} of numpy is of another kind than numpy writes", index + 1));
    }
    return arguments.items[index];
  }

  /** "f4", "<f8", "U12", "O8". */
  void ReadTypeCode(const std::string& code, PickleValue& dtype) const {
    size_t at = 0;
    if (at < code.size() && std::string_view("<>|=").find(code[at]) != std::string_view::npos) {
      dtype.is_big_endian = code[at++] == '>';
    }
    if (at == code.size()) return;
    const char type = code[at++];
    int64_t size = 0;
    for (; at < code.size() && code[at] >= '0' && code[at] <= '9' && size < 1'000'000; ++at) {
      size = size * 10 + (code[at] - '0');
    }
    if (at != code.size()) return;
    if (type == 'U') size *= 4;
    const bool is_number =
        (type == 'f' && (size == 2 || size == 4 || size == 8)) ||
        ((type == 'i' || type == 'u') && (size == 1 || size == 2 || size == 4 || size == 8)) ||
        (type == 'b' && size == 1);
    if (!is_number && type != 'U' && type != 'S' && type != 'O') return;
    dtype.type = type;
    dtype.element_size = size;
  }

  std::vector<int64_t> ReadShape(const PickleValue& shape) const {
    std::vector<int64_t> sizes;
    for (const PickleValue* size : shape.items) {
      if (size->kind != Kind::kInteger || !(size->number >= 0) || size->number > 1e12) {
        Fail("the shape of an array is not of whole numbers");
      }
      sizes.push_back(ToWhole<int64_t>(size->number));
    }
    return sizes;
  }

  void SetType(const PickleValue& dtype, PickleValue& array) const {
    array.type = dtype.type;
    array.is_big_endian = dtype.is_big_endian;
    array.element_size = dtype.element_size;
  }

  /** Shape and content agree, or the file lies about one of them. */
  void CheckSize(const PickleValue& array) const {
    double count = 1.0;
    for (const int64_t size : array.shape) count *= static_cast<double>(size);
    const double stored = array.type == 'O'   ? static_cast<double>(array.items.size())
                          : array.type == 'V' ? 0.0
                                              : static_cast<double>(array.data->text.size());
    const double expected = array.type == 'O'   ? count
                            : array.type == 'V' ? 0.0
                                                : count * static_cast<double>(array.element_size);
    if (stored != expected) {
      Fail(fmt::format("an array of {} elements ({} bytes each) has {} {}: damaged", count,
                       array.element_size, stored, array.type == 'O' ? "elements" : "bytes"));
    }
  }

  /** Bytes that were written as a text with one character a byte (protocol 2). */
  void Encode(const PickleValue& arguments) {
    const std::string& text = Argument(arguments, 0, Kind::kText)->text;
    const std::string& encoding = Argument(arguments, 1, Kind::kText)->text;
    if (encoding != "latin1" && encoding != "latin-1") {
      Fail("bytes in the encoding \"" + EscapeForTerminal(encoding) + "\"; numpy writes latin1");
    }
    encoded_ += text.size();
    if (encoded_ > bytes_.size()) Fail("more bytes are encoded than the file holds: damaged");
    std::string encoded;
    for (std::string_view rest = text; !rest.empty();) {
      const CodePoint point = ReadCodePoint(rest);
      if (point.size == 0 || point.value > 0xff) Fail("bytes with a character beyond latin1");
      encoded.push_back(static_cast<char>(static_cast<uint8_t>(point.value)));
      rest.remove_prefix(point.size);
    }
    Push(Kind::kBytes).text = std::move(encoded);
  }

  void Call() {
    const PickleValue* arguments = Pop();
    const PickleValue* name = Pop();
    if (arguments->kind != Kind::kTuple || name->kind != Kind::kName) {
      Fail("a call of something that is no function: damaged");
    }
    if (name->text == "encode") {
      Encode(*arguments);
    } else if (name->text == "dtype") {
      ReadTypeCode(Argument(*arguments, 0, Kind::kText)->text, Push(Kind::kDtype));
    } else if (name->text == "_reconstruct") {
      Push(Kind::kArray);  // what it holds comes with BUILD
    } else if (name->text == "scalar") {
      PickleValue& scalar = New(Kind::kArray);
      SetType(*Argument(*arguments, 0, Kind::kDtype), scalar);
      if (scalar.type == 'O') Fail("a numpy scalar that is an object");
      scalar.data = Argument(*arguments, 1, Kind::kBytes);
      CheckSize(scalar);
      stack_.push_back(&scalar);
    } else if (name->text == "_frombuffer") {
      PickleValue& array = New(Kind::kArray);
      array.data = Argument(*arguments, 0, Kind::kBytes);
      SetType(*Argument(*arguments, 1, Kind::kDtype), array);
      if (array.type == 'O') Fail("objects in a buffer: damaged");
      array.shape = ReadShape(*Argument(*arguments, 2, Kind::kTuple));
      array.is_fortran_order = Argument(*arguments, 3, Kind::kText)->text == "F";
      CheckSize(array);
      stack_.push_back(&array);
    } else {
      Fail("numpy." + name->text + " is called directly, which numpy's pickles never do");
    }
  }

  /** The state of an array or of a dtype. */
  void Build() {
    const PickleValue* state = Pop();
    if (state->kind != Kind::kTuple || stack_.empty() || !stack_.back()) {
      Fail("a state that is not numpy's: the pickle makes an object of a class");
    }
    PickleValue& target = *stack_.back();
    if (target.kind == Kind::kDtype) {
      const std::string& order = Argument(*state, 1, Kind::kText)->text;
      target.is_big_endian = order == ">";
      // Fields of a structure: their elements are not read.
      if (state->items.size() > 3 && state->items[3]->kind != Kind::kNone) target.type = 'V';
    } else if (target.kind == Kind::kArray && !target.data && target.items.empty()) {
      target.shape = ReadShape(*Argument(*state, 1, Kind::kTuple));
      SetType(*Argument(*state, 2, Kind::kDtype), target);
      target.is_fortran_order = Argument(*state, 3, Kind::kBool)->number != 0.0;
      if (target.type == 'O') {
        for (const PickleValue* item : Argument(*state, 4, Kind::kList)->items) {
          PutInto(target, item);
        }
      } else {
        target.data = Argument(*state, 4, Kind::kBytes);
      }
      CheckSize(target);
    } else {
      Fail("a state for something that is no array of numpy");
    }
  }

  void PushFloat() {
    const std::string_view big = Take(8);
    uint64_t bits = 0;
    for (const char byte : big) bits = bits << 8 | static_cast<uint8_t>(byte);
    double value = 0.0;
    std::memcpy(&value, &bits, sizeof value);
    PushNumber(Kind::kNumber, value);
  }

  void CheckProtocol(uint64_t protocol) const {
    if (protocol >= 2 && protocol <= kHighestProtocol) return;
    Fail(fmt::format("pickle protocol {}; 2 to {} are read", protocol, kHighestProtocol));
  }

  void Execute(uint8_t operation);

  std::string_view bytes_;
  const std::string& file_;
  size_t first_byte_;
  size_t at_ = 0;
  size_t operation_at_ = 0;
  size_t encoded_ = 0;
  std::vector<PickleValue*> stack_;
  std::map<uint64_t, PickleValue*> memo_;
  Pickle pickle_;
};

void PickleMachine::Execute(uint8_t operation) {
  switch (operation) {
    case 0x80:
      return CheckProtocol(TakeLittle(1));
    case 0x95:  // FRAME: only a hint for reading ahead
      TakeLittle(8);
      return;
    case '(':
      return stack_.push_back(nullptr);
    case '0':
      Pop();
      return;
    case '1':
      PopToMark();
      return;
    case 'N':
      return PushEmpty(Kind::kNone);
    case 0x88:
      return PushNumber(Kind::kBool, 1.0);
    case 0x89:
      return PushNumber(Kind::kBool, 0.0);
    case 'J':
      return PushNumber(Kind::kInteger, static_cast<int32_t>(static_cast<uint32_t>(TakeLittle(4))));
    case 'K':
      return PushNumber(Kind::kInteger, static_cast<double>(TakeLittle(1)));
    case 'M':
      return PushNumber(Kind::kInteger, static_cast<double>(TakeLittle(2)));
    case 0x8a:
      return PushLong(TakeLittle(1));
    case 0x8b:
      return PushLong(TakeLittle(4));
    case 'G':
      return PushFloat();
    case 0x8c:
      return PushText(Kind::kText, Take(TakeLittle(1)));
    case 'X':
      return PushText(Kind::kText, Take(TakeLittle(4)));
    case 0x8d:
      return PushText(Kind::kText, Take(TakeLittle(8)));
    case 'C':
      return PushText(Kind::kBytes, Take(TakeLittle(1)));
    case 'B':
      return PushText(Kind::kBytes, Take(TakeLittle(4)));
    case 0x8e:  // BINBYTES8
    case 0x96:
      return PushText(Kind::kBytes, Take(TakeLittle(8)));
    case ']':
      return PushEmpty(Kind::kList);
    case 'a':
      return AppendToList({Pop()});
    case 'e':
      return AppendToList(PopToMark());
    case ')':
      return PushEmpty(Kind::kTuple);
    case 't':
      return PushTuple(PopToMark());
    case 0x85:
      return PushTuple(PopValues(1));
    case 0x86:
      return PushTuple(PopValues(2));
    case 0x87:
      return PushTuple(PopValues(3));
    case '}':
      return PushEmpty(Kind::kDict);
    case 's':
      return AppendToDict(PopValues(2));
    case 'u':
      return AppendToDict(PopToMark());
    case 'q':
      return Memoize(TakeLittle(1));
    case 'r':
      return Memoize(TakeLittle(4));
    case 0x94:
      return Memoize(memo_.size());
    case 'h':
      return Recall(TakeLittle(1));
    case 'j':
      return Recall(TakeLittle(4));
    case 'c': {
      const std::string module_name(TakeLine());
      return PushName(module_name, std::string(TakeLine()));
    }
    case 0x93: {  // STACK_GLOBAL
      const PickleValue* name = Pop();
      const PickleValue* module_name = Pop();
      if (name->kind != Kind::kText || module_name->kind != Kind::kText)
        Fail("a name without text");
      return PushName(module_name->text, name->text);
    }
    case 'R':
      return Call();
    case 'b':
      return Build();
    default:
      Fail(
          fmt::format("operation 0x{:02x}, which plain values and arrays of numpy do not take; "
                      "nothing was executed. Save the grasps as a dictionary of numpy arrays, "
                      "numbers and texts",
                      operation));
  }
}

}  // namespace

Pickle ReadPickle(std::string_view bytes, const std::string& file, size_t first_byte) {
  return PickleMachine(bytes, file, first_byte).Run();
}

}  // namespace graspbench
