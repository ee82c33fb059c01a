#include "ft/fuzz/request_seeds.hpp"

#include <string>

#include "ft/fuzz/seed_file.hpp"

namespace lasso::fuzz {
namespace {

// What is done rather than read: where, and the body.
constexpr const char* kPosts[][2] = {
    {"/api/live/start", R"({"mission":"m.toml","scenario":"spin","seed":7,"pace":0.5})"},
    {"/api/live/connect", R"({"address":"udp://127.0.0.1:5300","mission":"m.toml"})"},
    {"/api/live/connect", R"({"address":"serial:/dev/ttyS0","mission":null})"},
    {"/api/live/command", R"({"name":"set_mode","values":{"mode":"safe"}})"},
    {"/api/live/command", R"({"name":"enable_laser","arm":true})"},
    {"/api/live/command", R"({"name":"set_structure_period","values":{"structure":"health","period_frames":"5"}})"},
    {"/api/live/command",
     R"({"name":"offer_start","values":{"start_source":"pose","t_us":"-1","p_sensor_target_m":"0,0.5,4e0","covariance":"1,0"}})"},
    {"/api/live/pace", R"({"pace":2})"},
    {"/api/live/stop", "{}"},
    {"/api/mission/look?id=m.toml", R"({"text":"[mission]\nid = 1\nversion = 1\nname = \"m\"\n[target]\nmesh = \"target.obj\"\n"})"},
    {"/api/mission/set?id=m.toml",
     R"({"text":"[mission]\nid = 1\nversion = 1\nname = \"m\"\n[target]\nmesh = \"target.obj\"\n","set":["mission.version=2"]})"},
    {"/api/mission/preview?id=m.toml",
     R"({"text":"[mission]\nid = 1\nversion = 1\nname = \"m\"\n[target]\nmesh = \"target.obj\"\n[scenario.s]\nranges_m = [4, 5]\nframes = 9\n",)"
     R"("scenario":"s","run":1})"},
    {"/api/mission/surface?id=m.toml", R"({"text":"[mission]\nid = 1\nversion = 1\nname = \"m\"\n[target]\nmesh = \"target.obj\"\n"})"},
    {"/api/mission/new?name=box&file=b.obj&scale=0.5", "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 3 2\nf 1 2 4\nf 1 4 3\nf 2 3 4\n"},
    {"/api/mission/save?id=m.toml", R"({"text":"[mission]\nid = 1\n","digest":"00ff"})"},
    {"/api/mission/copy?id=m.toml", R"({"name":"mine"})"}};

}  // namespace

// Who asks has the token, or not; then the request (request.cpp).
void write_requests(const std::filesystem::path& folder) {
  const char* const targets[] = {"/",
                                 "/api/about",
                                 "/api/recordings",
                                 "/api/recordings/ID",
                                 "/api/recordings/ID/frames?columns=time_s,valid,error.position",
                                 "/api/recordings/ID/frames/3",
                                 "/api/recordings/ID/frames/2/scan?iteration=1",
                                 "/api/recordings/ID/series?value=pose.inliers&from_s=0.001&to_s=1e3&points=3",
                                 "/api/recordings/ID/statistics?value=error.angle",
                                 "/api/recordings/ID/events?from=1&count=2&filter=lost%20&level=warning",
                                 "/api/recordings/ID/model.glb",
                                 "/api/recordings/ID/csv?values=pose.inliers,error.x",
                                 "/api/jobs/job1",
                                 "/api/live/commands",
                                 "/api/live/scenarios?mission=m.toml",
                                 "/api/mission?id=m.toml",
                                 "/?token=0011"};
  int number = 0;
  for (const char* target : targets) {
    const std::string request = std::string("GET ") + target + "\naccept-encoding: gzip\norigin: http://127.0.0.1:8080\n\nbody";
    for (const bool known : {false, true}) write(folder / std::to_string(number++), seed(known ? 1 : 0, request));
  }
  for (const auto& [target, body] : kPosts)
    write(folder / std::to_string(number++), seed(1, std::string("POST ") + target + "\ncontent-type: application/json\n\n" + body));
}

}  // namespace lasso::fuzz
