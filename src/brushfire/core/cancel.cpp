// The token of a thread.
#include <brushfire/core/cancel.h>

#include <brushfire/core/error.h>

#include <utility>

namespace brushfire {
namespace {

thread_local const CancelToken* current = nullptr;

}  // namespace

CancelScope::CancelScope(const CancelToken* token) noexcept : outer_(current) {
  if (token != nullptr) current = token;
}

CancelScope::~CancelScope() { current = outer_; }

const CancelToken* current_cancel_token() noexcept { return current; }

void stop_if_cancelled() {
  if (current != nullptr && current->cancelled()) throw Error(ErrorCode::Cancelled, "cancelled");
}

void Poll::look() {
  left_ = interval_;
  stop_if_cancelled();
}

}  // namespace brushfire
