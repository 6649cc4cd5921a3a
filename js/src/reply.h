// What a call gives back to JavaScript: arrays, or an error, in memory that lib/module.js reads and then frees.
//
// The C interface: numbers are passed as they are, arrays and texts as an address and a number of elements. Objects
// that stay (meshes, fields) are addresses, too; JavaScript owns them.
#pragma once

#include <brushfire/core/error.h>
#include <brushfire/core/types.h>

#include <cstdint>
#include <exception>
#include <initializer_list>
#include <memory>
#include <new>
#include <string>
#include <utility>
#include <vector>

// Before the definition of a function: it can be called from JavaScript under its own name.
#define BRUSHFIRE_EXPORT(name) extern "C" __attribute__((export_name(#name)))

namespace brushfire::js {

// In the order of lib/module.js.
enum class Kind : std::uint32_t { Text, Float64, Float32, Uint32, Int32, Uint8 };

template <class T>
inline constexpr Kind kKind = Kind::Uint8;
template <>
inline constexpr Kind kKind<double> = Kind::Float64;
template <>
inline constexpr Kind kKind<float> = Kind::Float32;
template <>
inline constexpr Kind kKind<std::uint32_t> = Kind::Uint32;
template <>
inline constexpr Kind kKind<std::int32_t> = Kind::Int32;
template <>
inline constexpr Kind kKind<char> = Kind::Text;

class Reply {
 public:
  template <class T>
  void add(std::vector<T> values) {
    keep(std::make_shared<std::vector<T>>(std::move(values)), kKind<T>);
  }
  void add(std::string text) { keep(std::make_shared<std::string>(std::move(text)), Kind::Text); }
  // Source and vertex numbers, of which kNoIndex reads -1.
  void add_signed(const std::vector<Index>& numbers) { add(std::vector<std::int32_t>(numbers.begin(), numbers.end())); }
  void add_numbers(std::initializer_list<double> numbers) { add(std::vector<double>(numbers)); }

  // In place of what there was: the code and the message.
  void fail(std::string code, std::string message) {
    *this = Reply();
    add(std::move(code));
    add(std::move(message));
    failed_ = 1;
  }

 private:
  struct Array {
    Kind kind;
    const void* data;
    std::uint32_t size;
  };

  template <class Values>
  void keep(std::shared_ptr<Values> values, Kind kind) {
    entries_.push_back({kind, values->data(), static_cast<std::uint32_t>(values->size())});
    owners_.push_back(std::move(values));
    arrays_ = entries_.data();
    count_ = static_cast<std::uint32_t>(entries_.size());
  }

  // These three first: lib/module.js reads them.
  const Array* arrays_ = nullptr;
  std::uint32_t count_ = 0, failed_ = 0;
  std::vector<Array> entries_;
  std::vector<std::shared_ptr<const void>> owners_;
};

// body(Reply&); what it throws becomes the reply.
template <class Body>
Reply* answer(const Body& body) {
  auto reply = std::make_unique<Reply>();
  try {
    body(*reply);
  } catch (const Error& e) {
    reply->fail(std::string(name_of(e.code())), e.what());
  } catch (const std::bad_alloc&) {
    reply->fail(std::string(name_of(ErrorCode::TooLarge)), "out of memory: a module of WebAssembly has 4 GB at most");
  } catch (const std::exception& e) {
    reply->fail(std::string(name_of(ErrorCode::Internal)), e.what());
  }
  return reply.release();
}

}  // namespace brushfire::js
