// SPDX-License-Identifier: Apache-2.0
// Killed at random moments of every write (25; SCONCE_KILLS says otherwise): what stands under the name is
// the old or the new content, whole, and the next run goes on.
#include <gtest/gtest.h>
#include <signal.h>

#include <chrono>
#include <cstdlib>
#include <random>
#include <thread>

#include "faulty_room.h"

namespace fs = std::filesystem;

namespace sconce {
namespace {

using Clock = std::chrono::steady_clock;

class Kill : public test::FaultyRoom {
 protected:
  static int times() {
    const char* asked = std::getenv("SCONCE_KILLS");
    return asked != nullptr ? std::stoi(asked) : 25;
  }

  /// Runs `a` and `b`, which write to `output` in turn, and kills them.
  /// @param resumes  with --resume what was killed ends as if it had not been
  void at_random(const std::vector<std::string>& a, const std::vector<std::string>& b,
                 const std::string& output, bool resumes = false) {
    done(a);
    const std::string old = content(path(output));
    const auto start = Clock::now();
    done(b);
    const std::chrono::duration<double> whole = Clock::now() - start;
    ASSERT_NE(content(path(output)), old);
    const std::string states[] = {old, content(path(output))};
    done(a);
    const std::vector<std::string> before = names();

    std::mt19937 random(1);
    std::uniform_real_distribution<double> share(0, 1);
    double reach = 1.1 * whole.count();  // less where the machine has become quicker since
    const int kills = times();
    int killed = 0, replaced = 0, stands = 0, last = -1;
    bool others = false;  // killed between its last two steps, the run before has left its state
    for (int k = 0; killed < kills; ++k) {
      ASSERT_LT(k, 4 * kills) << "most runs end before they are killed";
      const int next = 1 - stands;
      std::vector<std::string> words = next == 0 ? a : b;
      if (resumes && last == next) words.push_back("--resume");
      last = next;
      const pid_t process = test::start_sconce(words);
      std::this_thread::sleep_for(std::chrono::duration<double>(reach * share(random)));
      ::kill(process, SIGKILL);
      int status = 0;
      ::waitpid(process, &status, 0);
      const bool refused =
          WIFEXITED(status) && WEXITSTATUS(status) == 1 && others && words.back() == "--resume";
      ASSERT_TRUE(WIFSIGNALED(status) || WEXITSTATUS(status) == 0 || refused) << join(words, " ");
      if (refused) {
        ASSERT_EQ(content(path(output)), states[stands]);
        others = false, last = -1;  // the next one begins anew, as the line said
        continue;
      }
      if (WIFSIGNALED(status))
        ++killed;
      else
        reach *= 0.95;
      const std::string now = content(path(output));
      ASSERT_TRUE(now == states[0] || now == states[1]) << "neither old nor new after " << k;
      if (now != states[stands]) stands = next, ++replaced, others = WIFSIGNALED(status);
    }
    std::cout << killed << " killed, " << replaced << " times replaced\n";
    done(b);
    EXPECT_EQ(content(path(output)), states[1]);
    done(a);
    EXPECT_EQ(content(path(output)), states[0]);
    EXPECT_EQ(names(), before) << "what was killed leaves nothing behind for good";
  }
};

TEST_F(Kill, Bake) {
  at_random(bake("x.sconce", "1"), bake("x.sconce", "2"), "x.sconce", true);
}

TEST_F(Kill, Merge) {
  std::vector<std::string> merges[2];
  for (const std::string seed : {"1", "2"}) {
    std::vector<std::string>& merge =
        merges[seed == "1" ? 0 : 1] = {"merge", "-o", path("x.sconce"), "--quiet"};
    for (const std::string shard : {"0", "1"}) {
      std::vector<std::string> part = bake("s" + seed + ".sconce", seed);
      part.insert(part.end(), {"--shard", shard + "/2"});
      done(part);
      merge.push_back(path("s" + seed + ".shard-" + shard + "-of-2"));
    }
  }
  at_random(merges[0], merges[1], "x.sconce");
}

TEST_F(Kill, Mix) {
  done(bake("x.sconce", "1"));
  at_random({"mix", path("x.sconce"), "-o", path("m.exr"), "--quiet"},
            {"mix", path("x.sconce"), "left=off", "-o", path("m.exr"), "--quiet"}, "m.exr");
}

TEST_F(Kill, Export) {
  done(bake("x.sconce", "1"));
  at_random({"export", path("x.sconce"), "--scene", path("lit.glb"), "--quiet"},
            {"export", path("x.sconce"), "left=2", "--scene", path("lit.glb"), "--quiet"}, "lit.glb");
}

TEST_F(Kill, Transfer) {
  done(bake("x.sconce", "1"));
  std::vector<std::string> a = test::kSmallTransfer, b = a;
  a.insert(a.end(), {path("x.sconce"), "--seed", "1"});
  b.insert(b.end(), {path("x.sconce"), "--seed", "2"});
  at_random(a, b, "x.sconce", true);
}

}  // namespace
}  // namespace sconce
