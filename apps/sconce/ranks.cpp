// SPDX-License-Identifier: Apache-2.0
#include "ranks.h"

#include <exception>

#include "core/error.h"

namespace sconce::app {

namespace {

// What goes round begins with one of these, so that a rank that fails is understood wherever others wait.
constexpr char kData = '+', kFailed = '!';

}  // namespace

Ranks RankSession::ranks() {
  return {index_, count_, [this](std::string_view mine) { return exchange(mine); }};
}

std::vector<std::string> RankSession::exchange(std::string_view mine) {
  std::vector<std::string> all = allgather(kData + std::string(mine));
  for (std::size_t rank = 0; rank < all.size(); ++rank) {
    if (all[rank].front() == kFailed) {
      all_failed_ = true;
      throw Error("rank " + std::to_string(rank), all[rank].substr(1));
    }
    all[rank].erase(0, 1);
  }
  return all;
}

void RankSession::together(const std::function<void()>& f) {
  if (count_ == 1) return f();
  try {
    f();
  } catch (const Cancelled&) {
    throw;
  } catch (const std::exception& error) {
    if (!all_failed_) allgather(kFailed + std::string(error.what()));
    all_failed_ = true;
    throw;
  }
  exchange({});
}

int RankSession::guard(const std::function<int()>& f) {
  if (count_ == 1) return f();
  try {
    const int code = f();
    return index_ == 0 ? code : 0;  // a launcher ends all others when one fails; the first is to speak
  } catch (const std::exception& error) {
    if (all_failed_) {
      if (index_ == 0) throw;
      return 0;
    }
    if (dynamic_cast<const Cancelled*>(&error) == nullptr)
      abort("rank " + std::to_string(index_) + ": " + error.what());
    abort(index_ == 0 ? "stopped, by a signal or because another rank has ended; what is finished is kept "
                        "(--resume goes on)"
                      : "");
  }
}

}  // namespace sconce::app
