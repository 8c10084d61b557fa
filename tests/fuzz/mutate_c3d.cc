/** @file
Mutations of the C3D fuzz target: every second one changes a parameter as its format has it, a type,
a dimension or a value of that type, instead of any bytes. Written from the C3D user guide (c3d.org),
not from the importer. */

#include <cstdint>
#include <cstring>
#include <limits>
#include <random>
#include <vector>

extern "C" size_t LLVMFuzzerMutate(uint8_t* data, size_t size, size_t max_size);
extern "C" size_t LLVMFuzzerCustomMutator(uint8_t* data, size_t size, size_t max_size,
                                          unsigned seed);

namespace {

/** A parameter in the file: where its type, its dimensions and its values stand. */
struct Place {
  size_t type, dimensions, values;
  int num_dimensions;
  size_t num_values, value_size;
};

std::vector<Place> FindParameters(const uint8_t* data, size_t size) {
  std::vector<Place> found;
  if (size < 2) return found;
  size_t at = static_cast<size_t>(data[0] > 0 ? data[0] - 1 : 0) * 512 + 4;  // of the first record
  while (at + 2 < size && data[at] != 0) {
    const auto name = static_cast<size_t>(std::abs(static_cast<int8_t>(data[at])));
    const auto group = static_cast<int8_t>(data[at + 1]);
    const size_t offset = at + 2 + name;
    if (offset + 4 >= size) break;
    int16_t next = 0;
    std::memcpy(&next, data + offset, sizeof next);
    if (group > 0) {
      const auto type = static_cast<int8_t>(data[offset + 2]);
      Place place = {offset + 2, offset + 4, 0, data[offset + 3], 1, 0};
      place.values = place.dimensions + static_cast<size_t>(place.num_dimensions);
      place.value_size = type == 4 ? 4 : type == 2 ? 2 : 1;
      for (size_t i = place.dimensions; i < place.values && i < size; ++i) {
        place.num_values *= data[i];
      }
      if (place.values + place.num_values * place.value_size <= size) found.push_back(place);
    }
    if (next <= 0) break;
    at = offset + static_cast<size_t>(next);
  }
  return found;
}

void ChangeValue(uint8_t* value, size_t size, std::mt19937& random) {
  if (size == 4) {
    constexpr float kInfinity = std::numeric_limits<float>::infinity();
    const float numbers[] = {
        -1.0F,   -0.5F,     0.0F,       1e-40F,
        0.5F,    65535.5F,  3e9F,       1.9e19F,
        3.4e38F, kInfinity, -kInfinity, -3e9F,
        1.0F,    2.0F,      32768.0F,   std::numeric_limits<float>::quiet_NaN()};
    std::memcpy(value, &numbers[random() % 16], sizeof(float));
  } else if (size == 2) {
    const int16_t numbers[] = {0, 1, -1, 2, 255, 256, 32767, -32768};
    std::memcpy(value, &numbers[random() % 8], sizeof(int16_t));
  } else {
    const uint8_t bytes[] = {0, 1, ' ', 127, 128, 255};
    *value = bytes[random() % 6];
  }
}

}  // namespace

size_t LLVMFuzzerCustomMutator(uint8_t* data, size_t size, size_t max_size, unsigned seed) {
  std::mt19937 random(seed);
  const std::vector<Place> parameters = FindParameters(data, size);
  if (parameters.empty() || random() % 2 == 0) return LLVMFuzzerMutate(data, size, max_size);
  const Place& place = parameters[random() % parameters.size()];
  const unsigned what = random() % 8;
  if (what == 0) {
    const int8_t types[] = {-1, 0, 1, 2, 4, 3};
    data[place.type] = static_cast<uint8_t>(types[random() % 6]);
  } else if (what == 1 && place.num_dimensions > 0) {
    data[place.dimensions + random() % static_cast<unsigned>(place.num_dimensions)] =
        static_cast<uint8_t>(random());
  } else if (place.num_values > 0) {
    ChangeValue(data + place.values + random() % place.num_values * place.value_size,
                place.value_size, random);
  }
  return size;
}
