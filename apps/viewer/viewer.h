// SPDX-License-Identifier: Apache-2.0
// The window's parts and the state that they share. What the state means is src/session's.
#pragma once

#include <deque>
#include <functional>
#include <map>
#include <memory>

#include "gpu/lamp_shader.h"
#include "image/frames.h"
#include "session/background.h"
#include "session/gizmo.h"
#include "session/goals.h"
#include "session/look.h"
#include "session/measure.h"
#include "session/motion.h"
#include "session/movers.h"
#include "session/presets_near.h"
#include "session/reading.h"
#include "session/reference.h"
#include "session/remembered.h"
#include "viewer/canvas.h"
#include "viewer/sheet.h"
#include "viewer/window.h"

namespace sconce::viewer {

struct ViewRequest {
  std::filesystem::path file;  ///< package, scene or picture; empty = none yet
  std::string groups_from;     ///< of pictures, see find_layers()
  std::vector<Action> script;  ///< then the window closes, unless it is empty
  int width = 0, height = 0;   ///< of the window; 0 = as it was the last time
  bool reflections = true;     ///< are followed while nothing moves
  bool forget = false;         ///< neither reads nor writes what is remembered
  /// Bakes a scene into packages, coarse ones first; called beside the window. Each package published stands
  /// until the next is.
  std::function<void(const std::filesystem::path& scene, const Progress&,
                     const std::function<void(std::filesystem::path)>& publish)>
      bake;
  /// Kinds that a lamp becomes by a click: name and words.
  std::vector<std::pair<std::string, std::string>> kinds;
  /// Words of the kind that a file makes, "" where it makes none; by its name.
  std::function<std::string(const std::string& file)> kind_of_file;
  /// What a lamp becomes, in the words of `sconce relight --kind`. @throws Error
  std::function<std::variant<MoreLights, gpu::LampShader>(const Lamp&, const LampPlace&,
                                                          const std::string& words)>
      become;
};

/// The measuring plane that is in the picture, and what was measured.
struct Plane {
  bool shown = false;
  float height = 0.75f, spacing = 0.5f;  ///< of one that is traced
  MeasuredPlane measured;                ///< without a name where it is traced
};

/// Lit by the package's probes.
struct Ball {
  Vec3 middle{0};
  float radius = 0.1f;
};

/// "300 lx here".
struct Goal {
  Vec3 position{0}, normal{0, 1, 0};
  double target = 300;
  std::vector<Rgb> lux;      ///< of each group, at unit weight, of all as it stands
  std::vector<Rgb> baked{};  ///< with all where it was baked
};

inline constexpr float kNear = 9;  ///< pixels that a hand may be off

/// Handles in a hand.
struct Drag {
  Grip grip = Grip::none;  ///< that is dragged
  Vec3 start{0};           ///< where what it moves was when the drag began
  Vec2 from{0};            ///< and the pointer
  bool held = false;
};

/// Lamps that are moved, where the package has an operator.
struct MovingLamps {
  std::shared_ptr<const Movable> home;  ///< null until it is prepared, or where there is none
  std::unique_ptr<LampMover> mover;     ///< likewise
  std::optional<std::size_t> chosen;
  bool shown = true;
  Drag drag;
  std::string problem;                                           ///< LampMover::problem() that was told
  std::string words;                                             ///< of the kind, while they are typed
  std::map<std::string, std::filesystem::file_time_type> files;  ///< of shaders, as they were read
  double looked = 0;                                             ///< when they were looked at
};

/// Objects that are moved.
struct MovingObjects {
  std::shared_ptr<ObjectMover> mover;   ///< null until an object has been moved and it is prepared
  bool sought = false, failed = false;  ///< it is being prepared, or has been; in vain
  std::string chosen;                   ///< "" = none
  Vec3 home{0};                         ///< middle of the chosen one
  Drag drag;
};

/// How a picture lies in the window.
struct SheetPlace {
  float zoom = 1;     ///< 1 = as large as there is room
  Vec2 middle{0.5f};  ///< of the window, as a share of the picture
};

using AnyOpened = std::variant<std::shared_ptr<const Opened>, std::shared_ptr<const OpenedPicture>>;

struct State {
  std::filesystem::path file;     ///< that is shown, as it was asked for; empty = none
  std::filesystem::path coming;   ///< the file that was asked for last; another one until it is there
  std::filesystem::path package;  ///< that is shown; another one where a scene is baked
  std::shared_ptr<const Opened> opened;
  std::unique_ptr<Canvas> canvas;  ///< of a package; else there may be a sheet
  std::unique_ptr<Sheet> sheet;    ///< of another renderer's picture
  SheetPlace place;
  std::unique_ptr<Session> session;
  Camera camera;
  LookKind look = LookKind::picture;
  std::map<LookKind, FalseColor> scales;
  std::string search;
  std::vector<NearPreset> moods;  ///< beside the file
  std::string mood_name;          ///< of the next to be saved, while it is typed
  bool reflections = true, help = false, reading = true, panels = true, resizing = false;
  std::optional<Reading> under;  ///< the pointer
  Plane plane;
  std::vector<MeasuredPlane> planes;             ///< baked ones, of all as it stands
  std::pair<MovedPlaces, ObjectMoves> measured;  ///< what was elsewhere then
  uint64_t measured_version = 0;                 ///< Movers::version() then
  MovingLamps lamps;
  MovingObjects objects;
  std::optional<Ball> ball;
  std::vector<Goal> goals;
  std::string sought;                                ///< what goal seeking found, in words
  Faders sought_faders;                              ///< that it found; the words are of these alone
  std::deque<std::pair<std::string, double>> notes;  ///< lines that fade, with the time they end
  ImVec2 canvas_at{0, 0}, canvas_size{1, 1};
  std::map<std::string, ImVec4> fader_places;  ///< for scripts: x, y, width, height of each track
  std::optional<Vec3> pivot;                   ///< while a drag turns around it
  double fade_seconds = 1;

  Movers movers() const { return {lamps.mover.get(), objects.mover.get()}; }
  /// Something is not where it was baked, nor is its light.
  bool away() const { return movers().any(); }
  bool dragging() const { return lamps.drag.grip != Grip::none || objects.drag.grip != Grip::none; }
  bool ready() const { return canvas != nullptr || sheet != nullptr; }
  Screen& screen() const { return sheet ? static_cast<Screen&>(*sheet) : *canvas; }
  FalseColor& scale() { return scales[look]; }
};

class Viewer {
 public:
  explicit Viewer(const ViewRequest& request);
  ~Viewer();
  void run();

 private:
  friend class Driver;
  void open(const std::filesystem::path& file);
  void drop(const std::filesystem::path& file);
  void show(std::shared_ptr<const Opened> opened);
  void show(std::shared_ptr<const OpenedPicture> opened);
  /// Faders, exposure and scales as they are when something else is opened.
  void start_session(const std::vector<GroupInfo>& groups, std::vector<SceneLamp> lamps = {});
  void take_results();
  /// What was found by rays for what was shown.
  void forget_light();
  void frame(double wait);
  void draw_canvas(ImVec2 at, ImVec2 size);
  void draw_sheet(ImVec2 at, ImVec2 size);
  void begin_picture(ImVec2 at, ImVec2 size);
  void navigate();
  void keys();
  void set_look(LookKind look);
  /// What is shown of planes and goals and not baked: by paths, all as it stands.
  void measure();
  void take_measured(std::vector<MeasuredLight> parts);
  /// Measures anew where lamps or objects have come to rest elsewhere.
  void follow_moves();
  /// One that is traced.
  void show_plane();
  void show_plane(const MeasuredPlane& baked);
  /// Figures of all planes as mixed, a line each, with a head. @throws Error
  /// What comes is there: its name in the title and among the recent files.
  void name_shown();
  void write_figures(const std::filesystem::path& file) const;
  /// @throws Error where the package has no probes
  void place_ball(const Vec3& middle, float radius);
  void ball_overlay(ImDrawList& draw, const Lens& from) const;
  void forget_lamps();
  void prepare_lamps();
  void light_lamps();
  /// @param gesture  further moves of the same lamp are the same step of undo
  void move_lamp(std::size_t lamp, const Vec3& to, bool gesture);
  /// The chosen lamp or object goes home.
  void put_back();
  void aim_lamp(std::size_t lamp, const Vec3& target);
  /// @param kind  see MovedLamp; "" = its own
  void set_kind(std::size_t lamp, const std::string& kind);
  /// What it has become. @throws Error
  OtherLamp other_lamp(std::size_t lamp, const MovedLamp& state);
  /// Lamps whose files have changed are made anew.
  void watch_lamp_files();
  void lamp_section();
  /// @param at  the pointer, in the picture. @return whether it holds a lamp
  bool hold_lamp(Vec2 at);
  void forget_objects();
  void light_objects();
  /// Lamps shine in the scene as its objects stand.
  void light_lamps_among_objects();
  /// @throws UsageError naming those that there are
  void choose_object(const std::string& name, const std::string& where = {});
  Vec3 object_place() const;
  /// The chosen one, as move_lamp().
  float object_turn() const;
  void move_object(const Vec3& to, float turn, bool gesture);
  bool hold_object(Vec2 at);
  void object_overlay();
  void object_section();
  /// Whether objects are not yet where they are wanted.
  bool objects_pending() const;
  /// That, or their light is not all there yet.
  bool objects_moving() const;
  /// How far bounces are behind objects; "" = not at all.
  std::string behind() const;
  /// The scene as it stands, for looking at it.
  const View& rays() const;
  /// @return whether a handle of what stands there is held now
  bool take_grip(Drag& drag, const Vec3& place, Vec2 at) const;
  void draw_handles(const Vec3& place, Grip held, const std::string& name) const;
  Lens lens() const;
  /// In the window, pixels; none out of sight.
  std::optional<ImVec2> on_screen(const Lens& from, const Vec3& point) const;
  std::optional<ImVec2> handle_at(const Vec3& place, Grip grip) const;
  void lamp_overlay();
  void add_goal(const Vec3& position, const Vec3& normal, double target, std::vector<Rgb> lux);
  void seek();
  void seek_picture(const std::filesystem::path& file);
  void refine_reference();
  /// @param part  of the picture's width and height is its resolution, 1 / part
  void trace_reference(int part);
  /// A scale that fits the mix. @param scale  whose kind is kept
  FalseColor scale_for(LookKind look, const Metering& metering, const FalseColor& scale = {}) const;
  /// What mirrors show, by rays, as soon as the picture rests.
  void follow_mirrors();
  void screenshot();
  /// PNG as shown, OpenEXR linear. @throws Error
  void write_picture(const std::filesystem::path& file) const;
  void save_preset();
  void find_moods();
  void fade_to_file(const std::filesystem::path& preset);
  /// @param output  as `sconce render --turntable` takes it @throws as Frames
  void begin_turn(const std::string& output, int count);
  /// A film, or numbered pictures where ffmpeg is not installed.
  void begin_turn();
  void stop_turn();
  /// Keeps a picture of it that has come to rest, and goes on.
  void turn();
  /// Keeps what was baked. @param target  empty = beside the scene
  void save_package(std::filesystem::path target);
  /// Writes the scene as it is mixed. @param target  empty = beside the package
  void save_scene(std::filesystem::path target);
  Metering metering_now() const;
  void note(const std::string& line);
  /// Runs what a button does; what it throws becomes a note.
  void attempt(const std::function<void()>& work);
  bool busy() const;

  // Panels, one file each.
  void top_bar(ImVec2 at, ImVec2 size);
  void opened_bar();
  void status_bar(ImVec2 at, ImVec2 size);
  void side_panel(ImVec2 at, ImVec2 size);
  void mix_panel();
  void moods_section();
  void fader_row(std::size_t group);
  /// A group in words: flux, light, lamps.
  std::string about(std::size_t group) const;
  void color_popup(std::size_t group);
  void look_panel();
  void design_panel();
  void plane_section();
  void standing_line();
  void baked_section();
  void overlays();
  void legend(ImDrawList& draw);
  /// A card with each group's share. @param light  of each group; @return where its headline begins
  ImVec2 reading_card(ImDrawList& draw, const std::vector<float>& light);
  void help_card();
  void welcome(ImVec2 at, ImVec2 size);

  ViewRequest request_;
  Remembered remembered_;
  Window window_;
  State state_;
  std::vector<Action> script_;
  Background<AnyOpened> opening_;
  Background<std::filesystem::path> baking_;
  Background<std::vector<MeasuredLight>> measuring_;
  Background<MeasuredLight> tracing_;
  Background<std::shared_ptr<const Movable>> preparing_;
  Background<LampMover::Fine> refining_;
  Background<std::shared_ptr<ObjectMover>> finding_;
  Background<ObjectMover::Fine> shading_;
  Background<ObjectBounces> following_;
  Background<Image> mirroring_;
  struct Turning {
    Camera start;
    Vec3 axis;
    int count, at = 0;
    std::shared_ptr<Frames> frames;
    bool rested = false;
  };
  std::optional<Turning> turning_;
  Background<std::string> filming_;  ///< what was written
  /// Milliseconds of a frame in which faders moved, by a script.
  struct FrameTime {
    double own, drawing;
  };
  std::vector<FrameTime> times_;
  uint64_t mirrored_ = 0;                               ///< Canvas::version() that rays were sent for
  std::optional<ReferencePicture> reference_, coming_;  ///< that is shown; whose first light is traced
  int coming_part_ = 0;                                 ///< see trace_reference()
  std::optional<MeasuredLight> traced_;
  bool drawing_more_ = false, want_shot_ = false;
  std::optional<Image8> shot_;
  std::optional<Hands> hands_;
  std::filesystem::path own_folder_;  ///< of what is baked; goes when the window does
};

/// Opens the window and returns when it is closed, or when the script has ended.
/// @throws Error: no display, old OpenGL, and in a script whatever goes wrong
void show_window(const ViewRequest& request);

}  // namespace sconce::viewer
