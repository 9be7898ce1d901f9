// SPDX-License-Identifier: Apache-2.0
#include "viewer/window.h"

#define GLFW_INCLUDE_NONE
#include <GLFW/glfw3.h>
#include <backends/imgui_impl_glfw.h>
#include <backends/imgui_impl_opengl3.h>

#include <algorithm>
#include <map>
#include <utility>

#include "core/error.h"
#include "gpu/window_target.h"
#include "viewer/theme.h"

namespace sconce::viewer {

namespace {

constexpr const char* kInstead =
    "a desktop, `xvfb-run sconce view ...`, or `sconce render` and `sconce fit`, which need no display";

std::string what_glfw_says() {
  const char* text = nullptr;
  glfwGetError(&text);
  return text != nullptr ? text : "unknown failure";
}

}  // namespace

struct Window::State {
  GLFWwindow* window = nullptr;
  std::unique_ptr<gpu::Context> context;
  std::vector<std::string> dropped;
  bool imgui = false;

  ~State() {
    if (imgui) {
      ImGui_ImplOpenGL3_Shutdown();
      ImGui_ImplGlfw_Shutdown();
      ImGui::DestroyContext();
    }
    context.reset();
    if (window != nullptr) glfwDestroyWindow(window);
    glfwTerminate();
  }
};

Window::Window(int width, int height, const std::string& title) : state_(std::make_unique<State>()) {
  if (glfwInit() != GLFW_TRUE)
    throw Error("view", "no window can be opened here: " + what_glfw_says(), kInstead);
  glfwWindowHint(GLFW_CONTEXT_VERSION_MAJOR, 4);
  glfwWindowHint(GLFW_CONTEXT_VERSION_MINOR, 5);
  glfwWindowHint(GLFW_OPENGL_PROFILE, GLFW_OPENGL_CORE_PROFILE);
  glfwWindowHint(GLFW_SCALE_TO_MONITOR, GLFW_TRUE);
  state_->window = glfwCreateWindow(width, height, title.c_str(), nullptr, nullptr);
  if (state_->window == nullptr)
    throw Error("view", "this display has no OpenGL 4.5: " + what_glfw_says(), kInstead);
  glfwMakeContextCurrent(state_->window);
  glfwSwapInterval(1);
  state_->context = gpu::Context::adopt(true);
  glfwSetWindowUserPointer(state_->window, state_.get());
  glfwSetDropCallback(state_->window, [](GLFWwindow* window, int count, const char** paths) {
    auto* state = static_cast<State*>(glfwGetWindowUserPointer(window));
    state->dropped.insert(state->dropped.end(), paths, paths + count);
  });
  ImGui::CreateContext();
  ImGui::GetIO().IniFilename = nullptr;  // the layout is fixed; its sizes are kept elsewhere
  float scale = 1;
  glfwGetWindowContentScale(state_->window, &scale, nullptr);
  set_theme(scale);
  ImGui_ImplGlfw_InitForOpenGL(state_->window, true);
  ImGui_ImplOpenGL3_Init("#version 450 core");
  state_->imgui = true;
}

Window::~Window() = default;

const gpu::Context& Window::context() const {
  return *state_->context;
}

bool Window::closing() const {
  return glfwWindowShouldClose(state_->window) == GLFW_TRUE;
}

void Window::close() {
  glfwSetWindowShouldClose(state_->window, GLFW_TRUE);
}

void Window::set_title(const std::string& title) {
  glfwSetWindowTitle(state_->window, title.c_str());
}

ImVec2 Window::size() const {
  int width = 0, height = 0;
  glfwGetWindowSize(state_->window, &width, &height);
  return {static_cast<float>(width), static_cast<float>(height)};
}

void Window::begin_frame(double wait, const std::optional<Hands>& hands) {
  if (wait > 0)
    glfwWaitEventsTimeout(wait);
  else
    glfwPollEvents();
  ImGui_ImplOpenGL3_NewFrame();
  ImGui_ImplGlfw_NewFrame();
  if (hands) {
    ImGuiIO& io = ImGui::GetIO();
    io.MousePos = hands->mouse.value_or(ImVec2(-FLT_MAX, -FLT_MAX));
    io.MouseDown[0] = hands->left;
    std::fill(std::begin(io.KeysDown), std::end(io.KeysDown), false);
    for (const int key : hands->keys) io.KeysDown[key] = true;
    io.AddInputCharactersUTF8(hands->text.c_str());
    io.KeyCtrl = hands->control, io.KeyShift = hands->shift;
  }
  ImGui::NewFrame();
}

std::optional<Image8> Window::end_frame(bool screenshot) {
  ImGui::Render();
  int width = 0, height = 0;
  glfwGetFramebufferSize(state_->window, &width, &height);
  gpu::clear_window(width, height);
  ImGui_ImplOpenGL3_RenderDrawData(ImGui::GetDrawData());
  std::optional<Image8> shot;
  if (screenshot) shot = gpu::read_window(width, height);
  glfwSwapBuffers(state_->window);
  return shot;
}

std::vector<std::string> Window::take_dropped() {
  return std::exchange(state_->dropped, {});
}

int key_of(const std::string& name) {
  if (name.size() == 1 && name[0] >= 'a' && name[0] <= 'z') return GLFW_KEY_A + (name[0] - 'a');
  if (name.size() == 1 && name[0] >= '0' && name[0] <= '9') return GLFW_KEY_0 + (name[0] - '0');
  if (name.size() == 2 && name[0] == 'f' && name[1] >= '1' && name[1] <= '9')
    return GLFW_KEY_F1 + (name[1] - '1');
  static const std::map<std::string, int> named = {
      {"space", GLFW_KEY_SPACE}, {"escape", GLFW_KEY_ESCAPE}, {"tab", GLFW_KEY_TAB},
      {"enter", GLFW_KEY_ENTER}, {"left", GLFW_KEY_LEFT},     {"right", GLFW_KEY_RIGHT},
      {"up", GLFW_KEY_UP},       {"down", GLFW_KEY_DOWN},     {"f12", GLFW_KEY_F12}};
  const auto found = named.find(name);
  return found == named.end() ? 0 : found->second;
}

}  // namespace sconce::viewer
