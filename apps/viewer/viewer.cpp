// SPDX-License-Identifier: Apache-2.0
#include "viewer/viewer.h"

#include <fmt/format.h>

#include <chrono>
#include <utility>

#include "core/error.h"
#include "core/files.h"
#include "core/text.h"
#include "gpu/window_target.h"
#include "image/io.h"
#include "viewer/driver.h"
#include "viewer/theme.h"

namespace fs = std::filesystem;

namespace sconce::viewer {

namespace {

constexpr double kNoteSeconds = 6;
constexpr int kFirstPart = 8, kReferencePart = 2;  // of the picture: what is seen first, and what is refined

Remembered start_with(const ViewRequest& request) {
  Remembered r = request.forget ? Remembered{} : remember(remembered_file());
  if (request.width > 0) r.width = request.width, r.height = request.height;
  return r;
}

bool ends_with_any(const fs::path& file, std::initializer_list<const char*> endings) {
  const std::string ending = lower(file.extension().string());
  return std::any_of(endings.begin(), endings.end(), [&](const char* e) { return ending == e; });
}

}  // namespace

Viewer::Viewer(const ViewRequest& request)
    : request_(request),
      remembered_(start_with(request)),
      window_(remembered_.width, remembered_.height, "sconce"),
      script_(request.script) {
  state_.reflections = request_.reflections;
  if (!script_.empty()) hands_.emplace();
  if (!request.file.empty()) open(request.file);
}

Viewer::~Viewer() {
  baking_.stop(), opening_.stop(), measuring_.stop(), tracing_.stop(), preparing_.stop(), refining_.stop(),
      mirroring_.stop(), filming_.stop(), finding_.stop(), shading_.stop(), following_.stop();
  std::error_code ignored;
  if (!own_folder_.empty()) fs::remove_all(own_folder_, ignored);
  if (request_.forget) return;
  remembered_.width = static_cast<int>(window_.size().x);
  remembered_.height = static_cast<int>(window_.size().y);
  keep(remembered_, remembered_file());
}

void Viewer::run() {
  std::optional<Driver> driver;
  if (!script_.empty()) driver.emplace(*this, script_);
  while (!window_.closing()) {
    if (driver && !driver->step()) break;
    // Asleep while nothing moves; a script waits for nobody.
    frame(driver || drawing_more_ || busy() ? 0 : 0.1);
  }
}

void Viewer::frame(double wait) {
  window_.begin_frame(busy() && !drawing_more_ && wait > 0 ? 0.03 : wait, hands_);
  const Stopwatch frame_watch;
  const std::vector<Rgb> before =
      hands_ && state_.ready() ? state_.screen().mix().weights : std::vector<Rgb>();
  for (const std::string& file : window_.take_dropped()) attempt([&] { drop(file); });
  take_results();
  keys();
  if (state_.session) drawing_more_ = state_.session->advance(static_cast<double>(ImGui::GetIO().DeltaTime));

  const ImVec2 all = ImGui::GetIO().DisplaySize;
  const float top = px(44), bottom = px(26);
  const float side = state_.ready() && state_.panels ? std::min(px(remembered_.panel), 0.6f * all.x) : 0;
  const ImVec2 canvas_at(0, top), canvas_size(all.x - side, all.y - top - bottom);
  if (state_.ready()) {
    state_.sheet ? draw_sheet(canvas_at, canvas_size) : draw_canvas(canvas_at, canvas_size);
    attempt([&] { turn(); });
    if (side > 0) side_panel({all.x - side, top}, {side, all.y - top - bottom});
  } else {
    welcome(canvas_at, canvas_size);
  }
  top_bar({0, 0}, {all.x, top});
  status_bar({0, all.y - bottom}, {all.x, bottom});
  help_card();
  const Stopwatch end_watch;
  shot_ = window_.end_frame(want_shot_);
  if (hands_ && state_.ready() && state_.screen().mix().weights != before) {
    gpu::finish_window();  // else what is drawn yet would slow the next frame's own work down
    const double drawing = end_watch.milliseconds() + state_.screen().drawing_milliseconds();
    times_.push_back({frame_watch.milliseconds() - drawing, drawing});
  }
  want_shot_ = false;
}

void Viewer::drop(const fs::path& file) {
  if (const std::string kind = request_.kind_of_file(file.string()); !kind.empty()) {
    if (!state_.lamps.chosen) throw Error(file.string(), "is a lamp: choose one that is to become it");
    return set_kind(*state_.lamps.chosen, kind);
  }
  if (ends_with_any(file, {".toml"}) && state_.session) return fade_to_file(file);
  if (ends_with_any(file, {".png", ".jpg", ".jpeg", ".exr", ".hdr"}) && state_.session)
    return seek_picture(file);
  open(file);
}

void Viewer::open(const fs::path& file) {
  if (!fs::exists(file)) throw Error(file.string(), "no such file");
  baking_.stop();
  fs::path whole = file.has_filename() ? file : file.parent_path();
  state_.coming = whole;
  if (fs::is_directory(whole)) {
    opening_.start(
        [whole](const Progress&, const auto& publish) { publish(std::make_shared<const Opened>(whole)); });
  } else if (ends_with_any(whole, {".exr"})) {
    opening_.start([whole, groups_from = request_.groups_from](const Progress&, const auto& publish) {
      publish(std::make_shared<const OpenedPicture>(whole, groups_from));
    });
  } else {
    if (!request_.bake) throw Error(file.string(), "is no package");
    baking_.start([this, whole](const Progress& progress, const auto& publish) {
      request_.bake(whole, progress, publish);
    });
  }
}

void Viewer::take_results() {
  if (const auto package = baking_.take()) {
    own_folder_ = package->parent_path();
    const fs::path path = *package;
    opening_.start(
        [path](const Progress&, const auto& publish) { publish(std::make_shared<const Opened>(path)); });
  }
  if (auto opened = opening_.take())
    attempt([&] { std::visit([&](auto& what) { show(std::move(what)); }, *opened); });
  if (auto parts = measuring_.take()) take_measured(std::move(*parts));
  if (auto light = tracing_.take()) {
    traced_ = std::move(*light);
    if (coming_) reference_ = std::exchange(coming_, {});
    if (coming_part_ != kReferencePart) trace_reference(kReferencePart);
  }
  if (state_.opened) attempt([&] { light_objects(); });
  if (state_.ready()) attempt([&] { light_lamps(); });
  if (state_.ready()) attempt([&] { follow_moves(); });
  for (const std::string& problem :
       {opening_.take_problem(), baking_.take_problem(), measuring_.take_problem(), tracing_.take_problem(),
        preparing_.take_problem(), refining_.take_problem(), mirroring_.take_problem(),
        filming_.take_problem(), finding_.take_problem(), shading_.take_problem(), following_.take_problem()})
    if (!problem.empty()) note(problem);
}

void Viewer::forget_light() {
  measuring_.stop(), tracing_.stop(), mirroring_.stop();
  mirrored_ = 0;
  reference_.reset(), coming_.reset(), traced_.reset();
}

void Viewer::show(std::shared_ptr<const Opened> opened) {
  forget_light();
  stop_turn();
  auto canvas = std::make_unique<Canvas>(window_.context(), opened);
  const std::vector<GroupInfo>& groups = opened->package.manifest().groups;
  // A finer bake of the same scene: faders, camera and goals stay.
  const auto alike = [](const GroupInfo& a, const GroupInfo& b) { return a.name == b.name; };
  const bool again = state_.session && state_.opened && !own_folder_.empty() &&
                     state_.file == state_.coming &&
                     std::equal(groups.begin(), groups.end(), state_.session->groups().begin(),
                                state_.session->groups().end(), alike);
  state_.canvas = std::move(canvas);
  name_shown();
  forget_objects();
  state_.sheet.reset();
  state_.opened = std::move(opened);
  state_.package = state_.opened->package.path();
  state_.planes = state_.opened->planes;
  prepare_lamps();
  if (again) {
    if (!state_.plane.shown) return;
    const std::string& name = state_.plane.measured.name;
    const auto baked = std::find_if(state_.opened->planes.begin(), state_.opened->planes.end(),
                                    [&](const MeasuredPlane& plane) { return plane.name == name; });
    baked == state_.opened->planes.end() ? show_plane() : show_plane(*baked);
    return;
  }
  state_.camera = state_.opened->rays.camera("");
  start_session(groups, movable_lamps(*state_.opened));
}

void Viewer::show(std::shared_ptr<const OpenedPicture> opened) {
  forget_light();
  forget_lamps();
  for (const std::string& name : opened->picture.picture.left_out)
    note("'" + name + "' is left out: only flat, full channels are kept");
  auto sheet = std::make_unique<Sheet>(window_.context(), std::move(opened));
  state_.canvas.reset(), state_.opened.reset(), state_.under.reset(), state_.package.clear();
  forget_objects();
  state_.sheet = std::move(sheet);
  name_shown();
  state_.place = {};
  start_session(state_.sheet->opened().picture.groups);
}

void Viewer::start_session(const std::vector<GroupInfo>& groups, std::vector<SceneLamp> lamps) {
  state_.session = std::make_unique<Session>(groups, std::move(lamps));
  state_.scales.clear(), state_.goals.clear(), state_.sought.clear();
  state_.look = LookKind::picture;
  state_.plane.shown = false, state_.ball.reset();
  // The exposure is metered once and held, so that a fader that goes down darkens the picture.
  const Metering metering = metering_now();
  state_.session->meter_once(metering);
  state_.session->forget_history();
  find_moods();
  for (const LookKind look : {LookKind::lux, LookKind::luminance})
    state_.scales[look] = scale_for(look, metering);
  state_.scales[LookKind::noise] = {.low = 0, .high = 20};
}

void Viewer::set_look(LookKind look) {
  if (state_.sheet && !row_of(look).of_pictures)
    return note("a picture has no " + std::string(row_of(look).name));
  state_.look = look;
  if (look == LookKind::reference) refine_reference();
}

FalseColor Viewer::scale_for(LookKind look, const Metering& metering, const FalseColor& scale) const {
  // Lux: of surfaces with an albedo of 0.8, so that the walls' fill the scale.
  const double bright = metering.bright * (look == LookKind::lux ? double{kPi} / 0.8 : 1);
  FalseColor fitted = fitting_scale(bright, scale.decades);
  fitted.lines = scale.lines;
  return fitted;
}

void Viewer::refine_reference() {
  reference_.reset(), traced_.reset();
  trace_reference(kFirstPart);
}

void Viewer::trace_reference(int part) {
  tracing_.stop();
  const int width = std::max(static_cast<int>(state_.canvas_size.x) / part, 16);
  const int height = std::max(static_cast<int>(state_.canvas_size.y) / part, 16);
  coming_.emplace(rays(), state_.camera, PictureParams{.width = width, .height = height, .samples = 1});
  coming_part_ = part;
  const Movers movers = state_.movers();
  std::shared_ptr<const StandingScene> standing;
  if (movers.any())
    standing =
        std::make_shared<StandingScene>(standing_scene(rays().scene(), rays().world(), movers.standing()));
  const auto meter = std::make_shared<PointMeter>(coming_->meter(standing));
  meter->add(rays(), movers.known(coming_->points()));
  tracing_.start([meter, opened = state_.opened, passes = part == kReferencePart ? 128 : 1,
                  mover = state_.objects.mover](const Progress& progress, const auto& publish) {
    for (int pass = 0; pass < passes; ++pass) {
      meter->pass(8, progress);
      publish(meter->light());
    }
  });
}

Metering Viewer::metering_now() const {
  const MixSpec mix = state_.session->mix();
  if (state_.sheet) return meter_picture(Mixer(state_.sheet->layers()).mix(mix).front());
  Mixer mixer(layers_of(state_.opened));
  const Movers movers = state_.movers();
  return state_.opened->meter(mix, movers.any() ? movers.pages(mixer, mix) : mixer.mix(mix));
}

void Viewer::note(const std::string& line) {
  state_.notes.emplace_back(line, ImGui::GetTime() + kNoteSeconds);
  if (state_.notes.size() > 5) state_.notes.pop_front();
}

void Viewer::attempt(const std::function<void()>& work) {
  try {
    work();
  } catch (const Error& error) {
    note(error.what());
  }
}

bool Viewer::busy() const {
  return opening_.running() || baking_.running() || measuring_.running() || tracing_.running() ||
         preparing_.running() || refining_.running() || mirroring_.running() || turning_ ||
         filming_.running() || finding_.running() || shading_.running() || following_.running() ||
         !state_.notes.empty();
}

void show_window(const ViewRequest& request) {
  Viewer(request).run();
}

}  // namespace sconce::viewer
