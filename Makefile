# The commands of this repository. `make help` lists them.
# The sources and the folder for all results; `make gates-selftest` sets others.
SOURCE ?= .
LASSO_OUT ?= out
export LASSO_OUT
BUILD := $(LASSO_OUT)/build
PPC := $(LASSO_OUT)/ppc
BENCH := $(LASSO_OUT)/build-bench
CLANG := $(LASSO_OUT)/build-clang
GOLDEN := $(LASSO_OUT)/build-golden
BOARD := $(LASSO_OUT)/board
SECOND := $(LASSO_OUT)/board-cortexa9
SANITIZE := $(LASSO_OUT)/build-sanitize
FUZZ := $(LASSO_OUT)/build-fuzz
COVERAGE := $(LASSO_OUT)/build-coverage
LINT := $(LASSO_OUT)/build-lint
MCDC := $(LASSO_OUT)/build-mcdc
SOFT := $(LASSO_OUT)/soft-float
MISSION ?= cfg/missions/$(if $(filter approach,$(SCENARIO)),hubble,hubble_tenth).toml
OUT ?= out/run
PREFIX ?= /usr/local
export JOBS ?= $(shell nproc)
CROSS = -DCMAKE_TOOLCHAIN_FILE=$(abspath cfg/toolchains/ppc603e.cmake) -DLASSO_GROUND=OFF -DLASSO_BARE_KERNEL=$(abspath $(BOARD))/bare_kernel.elf
# the flight images of the bare boards (docs/boards)
BARE_BOARD = -DCMAKE_TOOLCHAIN_FILE=$(abspath cfg/toolchains/ppc603e-bare.cmake) -DLASSO_GROUND=OFF -DLASSO_TESTS=OFF -DLASSO_UNITY=OFF
# what flies on the first one, with the call graph in each object for make prove: the same bits
FLIGHT_BOARD = $(BARE_BOARD) -DLASSO_CALL_GRAPH=ON
SECOND_BOARD = -DCMAKE_TOOLCHAIN_FILE=$(abspath cfg/toolchains/cortexa9-bare.cmake) -DLASSO_GROUND=OFF -DLASSO_TESTS=OFF -DLASSO_UNITY=OFF
# the fixed-point build (docs/decisions/fixed-point.md), and that of the host
FIXED = -DLASSO_NUMBER=fixed
FIXED_HOST = -DCMAKE_CXX_COMPILER=clang++-19 $(FIXED)
# $(call at_level,COMPILER,LEVEL): flight code and its tests at one level of optimisation, where the shipped build uses several
at_level = -DCMAKE_CXX_COMPILER=$(1) -DCMAKE_BUILD_TYPE=Level -DCMAKE_CXX_FLAGS_LEVEL=-$(2) -DLASSO_GROUND=OFF
# $(call sanitized,SANITIZERS) (a finding names its function; -g1 would name lines, too, and costs a sixth of the build), the tests that start threads,
# and those of the per-point path
comma := ,
sanitized = -DCMAKE_CXX_COMPILER=clang++-19 -DCMAKE_BUILD_TYPE=Level -DCMAKE_CXX_FLAGS_LEVEL=-O1 -DLASSO_COMMAND_LINE_OPTIONS=-O0 -DLASSO_SANITIZE=$(1)
# Elsewhere what most files include is parsed once (lasso_precompile); here each file has to include what it uses.
own_includes = -DCMAKE_DISABLE_PRECOMPILE_HEADERS=ON -DLASSO_UNITY=OFF
THREADED = ut_posix ut_exec
PER_POINT = ut_geometry ut_mission ut_pose
# At a landing (TIER=landing) the emulated 603e runs the tests of what depends on the processor: codecs, the loader, numbers.
ON_TARGET = ut_core ut_geometry ut_mission ut_sense ut_link ut_hal_lcs ut_sensors
landing := $(filter landing,$(TIER))
SOURCES = git ls-files -z '*.cpp' '*.hpp'

export CCACHE_BASEDIR := $(CURDIR)
export CCACHE_SLOPPINESS := pch_defines,time_macros
# Tests, rigs and runs share the models that mdat has compiled.
export MDAT_CACHE ?= $(abspath $(LASSO_OUT))/mission-cache
# Ninja's steps: one changing line on a terminal, a line each in a log.
export NINJA_STATUS := [%f/%t %es] 

# A family is one target, and a variable of the caller's says which of its commands is meant: $(call choice,TARGET,VARIABLE,VALUES) is the value that was
# given, or the first where none was. Another one ends make before anything is built.
given = $(or $(strip $($(2))),$(firstword $(3)))
refused = $(filter-out $(3),$(given))$(filter-out 1,$(words $(given)))
choice = $(if $(and $(filter $(1),$(MAKECMDGOALS)),$(refused)),$(error make $(1) takes $(2)=$(subst $(space),|,$(3)), not $(2)=$(given)))$(given)
empty :=
space := $(empty) $(empty)
# $(begin) of a gate (nothing old speaks for it), $(call begin,TARGET-VALUE) of one of a family (command_of in cfg/quality/gate.py), $(call packages,LISTS),
# $(call configure,FOLDER,CMAKE OPTIONS) (again if they change), $(call compile,FOLDER[,TARGETS]), $(call ctest,FOLDER,REPORTS[,OPTIONS])
begin = @rm -f $(LASSO_OUT)/$(or $(1),$@)/summary.json
packages = @cfg/packages/ensure $(1)
configure = @options='$(subst ',,$(2))'; \
  { [ -e $(1)/build.ninja ] && [ "$$(cat $(1)/options.txt 2>/dev/null)" = "$$options" ]; } || { echo "configure $(1)"; mkdir -p $(1); rm -f $(1)/CMakeCache.txt $(1)/build.ninja $(1)/options.txt; \
  cmake -S $(SOURCE) -B $(1) -G Ninja -DCMAKE_BUILD_TYPE=Release -DLASSO_UNITY=ON $$(command -v ccache >/dev/null && echo -DCMAKE_CXX_COMPILER_LAUNCHER=ccache) $(2) \
    >$(1)/configure.log 2>&1 || { cat $(1)/configure.log; rm -f $(1)/build.ninja; false; }; } && echo "$$options" >$(1)/options.txt
compile = @echo "build $(1)$(if $(2), ($(2)))"; cmake --build $(1) --parallel $(JOBS) $(if $(2),--target $(2))
# $(call tidy,FOLDER,ENDING): removes what sources that are gone left there, and would be counted: beside each object is its file of that ENDING.
tidy = @ninja -C $(1) -t cleandead >/dev/null; find $(1) -name '*.$(2)' | while read -r notes; do [ -e "$${notes%.$(2)}.o" ] || [ -e "$${notes%.$(2)}.obj" ] || rm "$$notes"; done
# The caller's settings of GoogleTest and of sanitizers do not count.
ctest = @rm -rf $(2); mkdir -p $(2); env $$(env | sed -n 's/^\(GTEST_[A-Z_]*\|ASAN_OPTIONS\|TSAN_OPTIONS\)=.*/-u \1/p') GTEST_OUTPUT=xml:$(abspath $(2))/ \
  ctest --test-dir $(1) --parallel $(JOBS) --output-on-failure --no-tests=error --output-junit $(abspath $(2))/ctest.xml $(3)

# each target that help lists
.PHONY: $(shell awk -F: '/^[a-z-]+:.*## / { print $$1 }' $(firstword $(MAKEFILE_LIST)))
.DEFAULT_GOAL := help

# Each description begins with its group: "TARGET: ## GROUP: WHAT". "## VARIABLE=VALUE: WHAT" behind a family says what one of its values does: of them the
# list has the names, and make help WHAT=TARGET all.
define help_by_group
BEGIN { n = split("first|measure|board|gate|write", order, "|")
  title["first"] = "Begin here"; title["measure"] = "Measure the component in simulation"
  title["board"] = "On the emulated flight processors"; title["gate"] = "Gates: each fails where something is wrong"
  title["write"] = "Write files of this repository" }
/^[a-z-]+:.*## / { split($$2, text, ": "); group[++rows] = text[1]; name[rows] = $$1; says[rows] = substr($$2, length(text[1]) + 3) }
/^## [A-Z]+=/ { split($$1, text, "[ =:]"); values[rows] = values[rows] (values[rows] ? "|" : text[2] "=") text[3]; split($$0, text, ": ")
  each[rows] = each[rows] sprintf("    %-20s %s\n", substr(text[1], 4), substr($$0, length(text[1]) + 3)) }
function row(i) { return sprintf("  make %-16s %s%s\n", name[i], says[i], values[i] && !of ? (says[i] ~ /=/ ? " " : ": ") values[i] : "") }
END { for (i = 1; of && i <= rows; ++i) if (name[i] == of) { printf "%s%s", row(i), each[i]; exit 0 }
  if (of) { print "make help: there is no target " of; exit 2 }
  for (k = 1; k <= n; ++k) { print title[order[k]]; for (i = 1; i <= rows; ++i) if (group[i] == order[k]) printf "%s", row(i); print "" } }
endef
export help_by_group
help: ## first: this list; make help WHAT=TARGET: what each value of its WHAT=, WHERE= or FLIGHT= does
	@awk -F ':.*## ' -v of="$(WHAT)" "$$help_by_group" $(firstword $(MAKEFILE_LIST))
	@[ -n "$(WHAT)" ] || echo "Scenarios of make run (make run SCENARIO=NAME; another mission by MISSION=FILE)"
	@[ -n "$(WHAT)" ] || for mission in cfg/missions/*.toml; do sed -n 's/^\[scenario\.\([^]]*\)\].*/\1/p' $$mission | xargs echo "  $$mission:"; done

run: ## first: track the tenth-scale Hubble in simulation, and write the report out/run/report.html: MISSION= SCENARIO= SENSOR=lcs-wire SEED= FRAMES= OUT=
	$(call packages,build)
	$(call configure,$(BUILD),)
	$(call compile,$(BUILD),mdat)
	@$(BUILD)/mdat/mdat run "$(MISSION)" $(if $(SCENARIO),--scenario $(SCENARIO)) $(if $(SEED),--seed $(SEED)) $(if $(SENSOR),--sensor $(SENSOR)) $(if $(FRAMES),--frames $(FRAMES)) --out "$(OUT)" --force
	@cfg/quality/measured.py run "$(OUT)/results.json"
	@echo "open the report: xdg-open '$(OUT)/report.html'"

# What it needs of npm stands at make page.
serve: ## first: show recordings in a browser: builds the page into mdat and prints its address: PLACE=FOLDER|FILE.mcap (.) PORT=
	$(page)
	$(call packages,build)
	$(call configure,$(BUILD),)
	$(call compile,$(BUILD),mdat)
	@exec $(BUILD)/mdat/mdat serve $(if $(PLACE),"$(PLACE)") $(if $(PORT),--port $(PORT))

GALLERY ?= $(LASSO_OUT)/gallery
recordings: ## measure: record a run, and read it with MCAP's reference library and Foxglove's reader of messages: MISSION= SCENARIO= FRAMES=
	$(call packages,build recordings)
	$(call configure,$(BUILD),)
	$(call compile,$(BUILD),mdat)
	@MISSION="$(MISSION)" SCENARIO="$(SCENARIO)" FRAMES="$(FRAMES)" ft/recordings/run $(BUILD)/mdat/mdat $(LASSO_OUT)/recordings

live: ## measure: watch a run while it flies, with the official client of the Foxglove WebSocket protocol: MISSION= SCENARIO= FRAMES=
	$(call packages,build recordings)
	$(call configure,$(BUILD),)
	$(call compile,$(BUILD),mdat)
	@MISSION="$(MISSION)" SCENARIO="$(SCENARIO)" FRAMES="$(FRAMES)" ft/live/run $(BUILD)/mdat/mdat $(LASSO_OUT)/live

gallery: ## measure: fly every shipped scenario and write a page of them all, out/gallery/index.html: FRAMES=
	$(call packages,build stereo)
	$(call configure,$(BUILD),)
	$(call compile,$(BUILD),mdat)
	@for mission in cfg/missions/*.toml; do for scenario in $$(sed -n 's/^\[scenario\.\([^]]*\)\].*/\1/p' $$mission); do \
	  $(BUILD)/mdat/mdat run $$mission --scenario $$scenario $(if $(FRAMES),--frames $(FRAMES)) --force --out "$(GALLERY)/$$(basename $$mission .toml)/$$scenario" || exit; done; done
	@$(BUILD)/mdat/mdat gallery "$(GALLERY)"
	@echo "open the page: xdg-open '$(GALLERY)/index.html'"

test: ## first: build and pass all unit and functional tests of the host; MESHES=all: missions of all kinds of meshes
	$(begin)
	$(call packages,build test stereo)
	$(call configure,$(BUILD),)
	$(call compile,$(BUILD))
	@cfg/quality/run-tests test g++=$(BUILD)

# The library for other languages is compiled here alone: mdat needs it not.
python: ## gate: python/lasso_mdat reads what mdat writes, registers and searches with its bits; its notebooks run
	$(begin)
	$(call packages,build python)
	$(call configure,$(BUILD),)
	$(call compile,$(BUILD),mdat lasso_mdat)
	@cfg/quality/python-package $(BUILD)

stereo: ## measure: render and match a stereo pair of the tenth-scale Hubble, out/stereo/disparity.png; installs OpenCV, which mdat stereo needs: MISSION= SCENARIO=
	$(call packages,build stereo)
	$(call configure,$(BUILD),)
	$(call compile,$(BUILD),mdat)
	@$(BUILD)/mdat/mdat stereo "$(MISSION)" $(if $(SCENARIO),--scenario $(SCENARIO)) --force --out $(LASSO_OUT)/stereo

accuracy: ## measure: errors of eight simulated scenarios against the limits of their requirements
	$(begin)
	$(call packages,build)
	$(call configure,$(BUILD),)
	$(call compile,$(BUILD),mdat)
	@for scenario in paper pointing spin rates tumble half_turn outliers dropouts; do $(BUILD)/mdat/mdat run cfg/missions/hubble_tenth.toml --scenario $$scenario --force \
	  --out $(LASSO_OUT)/accuracy/$$scenario || exit 1; done
	@cfg/quality/accuracy $(LASSO_OUT)/accuracy

BODIES ?= 1:200
TRIED := $(call choice,bodies,WHAT,track start search configuration compare)
bodies: ## measure: fly, start or search bodies that are made from seeds, and count wrong and missing poses: BODIES=1:200 FLIGHTS= SENSOR=laser|lidar SET="KEY=VALUE ..."
	$(call packages,build)
	$(call configure,$(BUILD),)
	$(call compile,$(BUILD),bodies)
	@$(BUILD)/ft/bodies/bodies "$(TRIED)" "$(BODIES)" "$(or $(FLIGHTS),$(if $(filter track,$(TRIED)),6,$(if $(filter configuration,$(TRIED)),10,20)))" "$(or $(FRAMES),60)" "$(or $(SENSOR),-)" "$(JOBS)" \
	  $(LASSO_OUT)/bodies/$(TRIED)$(if $(SENSOR),-$(SENSOR)) $(SET)
## WHAT=track: flights that start from the pose of one frame before: FRAMES=
## WHAT=start: single scans, registered from a rough pose
## WHAT=search: single scans, searched without any pose
## WHAT=configuration: single scans of a body that differs from its model: a part gone or turned
## WHAT=compare: the scans of WHAT=search: two other scores compare what is registered

WITH_BENCH = -DLASSO_BENCH=ON -DLASSO_TESTS=OFF
bench: ## measure: time the estimate, its stages, and closest-point ICP of Embree and PCL beside it
	$(call packages,build bench)
	$(call configure,$(BENCH),$(WITH_BENCH))
	$(call compile,$(BENCH),programs)
	@mkdir -p $(LASSO_OUT)/bench
	@ft/bench/run $(BENCH) $(LASSO_OUT)/bench

benchmark: ## measure: poses of rough starts on bodies that nobody tuned for, by the component and by its peers, scored alike: SEED=2001 COUNT=100 SCANS=20 SENSOR=laser_camera|lidar
	$(call packages,build bench)
	$(call configure,$(BENCH),$(WITH_BENCH))
	$(call compile,$(BENCH),mdat peer_poses)
	@ft/bench/benchmark $(BENCH) $(LASSO_OUT)/benchmark "$(or $(SEED),2001)" "$(or $(COUNT),100)" "$(or $(SCANS),20)" "$(SENSOR)"

CAMPAIGN := $(call choice,campaign,WHAT,montecarlo basin search endurance strangers sample)
campaign: ## measure: many flights, counted
	$(campaign-$(CAMPAIGN))

# $(call fly,CAMPAIGN,COUNT): a campaign of MISSION (ft/campaign/fly)
define fly
$(call packages,build)
$(call configure,$(BUILD),)
$(call compile,$(BUILD),mdat)
@ft/campaign/fly campaign-$(1) $(BUILD) "$(MISSION)" $(1) "$(2)" "$(SEED)"
endef
## WHAT=montecarlo: 2000 closed-loop flights drawn at random: how often a pose is missing or wrong: FLIGHTS= SEED= MISSION=
define campaign-montecarlo
$(call begin,campaign-montecarlo)
$(call fly,montecarlo,$(FLIGHTS))
endef
## WHAT=basin: 1000 starts that are 20 deg and 0.3 m off: how many are found: STARTS= SEED= MISSION=
define campaign-basin
$(call begin,campaign-basin)
$(call fly,basin,$(STARTS))
endef
## WHAT=search: the target found from 1000 random views in each case, without any prior attitude: CASE= STARTS= SEED= SCANS= SCALE= MISSION=
define campaign-search
$(call packages,build)
$(call configure,$(BUILD),)
$(call compile,$(BUILD),search)
@$(BUILD)/ft/search/search "$(MISSION)" $(or $(CASE),all) $(or $(STARTS),1000) $(or $(SEED),1) $(or $(SCANS),3) $(or $(SCALE),1)
endef
## WHAT=endurance: a day of simulated time at 5 Hz: nothing drifts, grows, slips or is wrong: HOURS= SEED=
define campaign-endurance
$(call begin,campaign-endurance)
$(call packages,build)
$(call configure,$(BUILD),)
$(call compile,$(BUILD),endurance)
@ft/campaign/run endurance $(BUILD) $(or $(HOURS),24) $(or $(SEED),1)
endef
## WHAT=strangers: a million packets of a stranger who knows the dictionary, against a component with a key, while it tracks: PACKETS=
define campaign-strangers
$(call begin,campaign-strangers)
$(call packages,build test)
$(call configure,$(BUILD),)
$(call compile,$(BUILD),ft_operations_stranger_test)
@LASSO_STRANGERS=$(or $(PACKETS),1000000) $(BUILD)/ft/operations/ft_operations_stranger_test
endef
## WHAT=sample: a seeded hundredth of fuzz, flips, statistics and the missions' campaigns; an hour of endurance: a gate
define campaign-sample
$(call begin,campaign-sample)
$(fuzzers)
$(replays)
$(call compile,$(BUILD),mdat endurance flips scrub)
@ft/campaign/sample $(BUILD) $(PPC) $(FUZZ)
endef

FLIPPED := $(call choice,flips,WHERE,host scrub target sample)
flips: ## measure: flights, each with one flipped bit
	$(flips-$(FLIPPED))

# $(call flip,PROGRAM,FLIPS)
define flip
$(call packages,build)
$(call configure,$(BUILD),)
$(call compile,$(BUILD),$(1))
@ft/campaign/run $(1) $(BUILD) $(or $(FLIPS),$(2)) $(or $(SEED),1)
endef
## WHERE=host: 10000 flips in memory or in a sample: masked, reported, silent: FLIPS= SEED=
define flips-host
$(call begin,flips-host)
$(call flip,flips,10000)
endef
## WHERE=scrub: 100000 flips in what the scrub protects: reported in time or not: FLIPS= SEED=
define flips-scrub
$(call begin,flips-scrub)
$(call flip,scrub,100000)
endef
# $(call seu,FLIPS,SEED,NAME) flips bits in the running board.
define seu
$(call packages,build target)
$(call configure,$(BUILD),)
$(call compile,$(BUILD),pil_seu)
$(call configure,$(BOARD),$(FLIGHT_BOARD))
$(call compile,$(BOARD),flight_603e layout_603e)
@ft/pil/seu.py $(BUILD) $(BOARD) $(1) $(2) $(3)
endef
## WHERE=target: 2000 flips in the running 603e; goes on where it was: FLIPS= SEED=
define flips-target
$(call begin,flips-target)
$(call seu,$(or $(FLIPS),2000),$(or $(SEED),1),flips-target)
endef
## WHERE=sample: eight of these, one in each region: a gate
define flips-sample
$(call begin,flips-sample)
@rm -rf $(LASSO_OUT)/flips-sample
$(call seu,8,2,flips-sample)
endef

# $(fuzzers) builds them, with what they test, for coverage and sanitizers.
define fuzzers
$(call packages,build clang)
$(call configure,$(FUZZ),$(call sanitized,fuzzer-no-link$(comma)address$(comma)undefined) -DLASSO_TESTS=OFF -DLASSO_FUZZ=ON)
$(call compile,$(FUZZ),fuzzers)
endef
fuzz: ## measure: a million inputs for each reader of outside bytes: FUZZERS="frame ..." EXECUTIONS= SECONDS_EACH= SEED= LARGEST=
	$(begin)
	$(fuzzers)
	@ft/fuzz/run $(FUZZ) $(or $(EXECUTIONS),$(if $(SECONDS_EACH),$(SECONDS_EACH)s),1000000) $(or $(SEED),1) $(or $(LARGEST),16384) $(FUZZERS)

# $(call linked_image,BOARD,IMAGE): a board's image with the shipped mission in itself.
define linked_image
$(call compile,$(BUILD),mdat)
@$(BUILD)/mdat/mdat mission compile cfg/missions/hubble_tenth.toml --out $(1)/mission.3dli >/dev/null
$(call compile,$(1),$(2))
endef
programs: ## gate: everything that make test does not compile is compiled, and no source is left out
	$(begin)
	$(call packages,build clang target target-arm bench soft-float)
	$(call configure,$(BUILD),)
	$(call compile,$(BUILD),programs)
	$(fuzzers)
	$(call configure,$(BENCH),$(WITH_BENCH))
	$(call compile,$(BENCH),programs)
	$(call configure,$(PPC),$(CROSS))
	$(call compile,$(PPC),programs)
	$(call configure,$(BOARD),$(FLIGHT_BOARD))
	$(call linked_image,$(BOARD),programs layout_603e)
	$(call configure,$(SECOND),$(SECOND_BOARD))
	$(call linked_image,$(SECOND),programs)
	@ft/ppc603e/soft_float/build $(SOFT)
	@cfg/quality/programs $(BUILD)=all,programs $(FUZZ)=fuzzers $(BENCH)=programs $(BOARD)=programs,layout_603e $(SECOND)=programs

commands: ## gate: what README.md and the pages of docs tell a reader to type works
	$(begin)
	$(call packages,build)
	$(call configure,$(BUILD),)
	$(call compile,$(BUILD),mdat)
	@cfg/quality/commands $(BUILD)

# Bodies made from seeds that are flown and replayed as well.
golden_bodies = $(if $(landing),2,20)
golden: ## board: telemetry is the same, bit for bit, on compilers, levels of optimisation, host and 603e
	$(begin)
	$(call packages,build target clang)
	$(call configure,$(BUILD),)
	$(call compile,$(BUILD),mdat golden_record golden_replay golden_compare)
	$(call configure,$(PPC),$(CROSS))
	$(call compile,$(PPC),golden_replay)
	$(call counted,golden_replay)
	$(if $(landing),,$(other_levels))
	@ft/golden/run --bodies $(golden_bodies) $(BUILD) $(PPC) clang++-O1=$(MCDC) $(if $(landing),,g++-O0=$(COVERAGE) $(foreach build,g++-O2 clang++-O0 clang++-O2,$(build)=$(GOLDEN)-$(build)))

define other_levels
$(call covered,golden_replay)
$(call configure,$(GOLDEN)-g++-O2,$(call at_level,g++,O2))
$(call compile,$(GOLDEN)-g++-O2,golden_replay)
$(call configure,$(GOLDEN)-clang++-O0,$(call at_level,clang++-19,O0))
$(call compile,$(GOLDEN)-clang++-O0,golden_replay)
$(call configure,$(GOLDEN)-clang++-O2,$(call at_level,clang++-19,O2))
$(call compile,$(GOLDEN)-clang++-O2,golden_replay)
endef

# The floating build's run is that of make accuracy, where no program or mission is newer.
PAPER := $(LASSO_OUT)/accuracy/paper
fixed-point: ## board: the fixed-point build: no floating point per point, its errors, the same bits on the 603e
	$(begin)
	$(call packages,build target clang)
	$(call configure,$(BUILD),)
	$(call compile,$(BUILD),mdat)
	$(call configure,$(CLANG),$(FIXED_HOST))
	$(call compile,$(CLANG),mdat golden_record golden_replay golden_compare)
	$(call configure,$(PPC)-fixed,$(CROSS) $(FIXED))
	$(call compile,$(PPC)-fixed,golden_replay)
	$(call configure,$(BOARD)-fixed,$(FLIGHT_BOARD) $(FIXED))
	$(call compile,$(BOARD)-fixed,flight_603e)
	@for folder in $(PPC)-fixed $(BOARD)-fixed; do ninja -C $$folder -t cleandead >/dev/null; done
	@[ $(PAPER)/results.json -nt $(BUILD)/mdat/mdat ] && [ -z "$$(find cfg/missions cfg/models -newer $(PAPER)/results.json)" ] || \
	  $(BUILD)/mdat/mdat run cfg/missions/hubble_tenth.toml --scenario paper --force --out $(PAPER)
	@$(CLANG)/mdat/mdat run cfg/missions/hubble_tenth.toml --scenario paper --force --out $(LASSO_OUT)/fixed-point/paper
	@LASSO_OUT=$(LASSO_OUT)/fixed-point ft/golden/run --bodies $(golden_bodies) $(CLANG) $(PPC)-fixed
	@cfg/quality/fixed-point cfg/quality/fixed-point.toml $(PAPER)/results.json $(LASSO_OUT)/fixed-point/paper/results.json $(PPC)-fixed $(BOARD)-fixed

# $(replays) builds what flies on the host and is replayed on the emulated 603e.
define replays
$(call packages,build target)
$(call configure,$(BUILD),)
$(call compile,$(BUILD),golden_record golden_replay golden_compare)
$(call configure,$(PPC),$(CROSS))
$(call compile,$(PPC),golden_replay)
endef
# the same processor without its floating-point unit (ft/ppc603e/soft_float)
soft = -DLASSO_SOFT_FLOAT=$(abspath $(SOFT))/libsoft_float.a
COUNTED := $(call choice,count,WHAT,estimate start search statistics)
count: ## board: instructions on the 603e
	$(count-$(COUNTED))

## WHAT=estimate: of one estimate, by function; both number types, with and without an FPU: FRAMES=
define count-estimate
$(call begin,count-estimate)
$(replays)
$(call packages,clang soft-float)
$(call configure,$(CLANG),$(FIXED_HOST))
$(call compile,$(CLANG),golden_record golden_replay golden_compare)
$(call configure,$(PPC)-fixed,$(CROSS) $(FIXED))
$(call compile,$(PPC)-fixed,golden_replay)
@ft/ppc603e/soft_float/build $(SOFT)
$(call configure,$(PPC)-soft,$(CROSS) $(soft))
$(call compile,$(PPC)-soft,golden_replay)
$(call configure,$(PPC)-soft-fixed,$(CROSS) $(soft) $(FIXED))
$(call compile,$(PPC)-soft-fixed,golden_replay)
@ft/ppc603e/count $(BUILD) $(PPC) $(FRAMES) fixed=$(CLANG),$(PPC)-fixed soft-float=$(BUILD),$(PPC)-soft soft-fixed=$(CLANG),$(PPC)-soft-fixed
endef
## WHAT=start: of an estimate from a rough start, and those beyond a frame: STARTS= SEED= MISSION= SCENARIO= RANGES=2,4,7
define count-start
$(call begin,count-start)
$(replays)
@ft/ppc603e/count-starts $(BUILD) $(PPC) $(or $(STARTS),300) $(or $(SEED),1) "$(MISSION)" "$(SCENARIO)" "$(RANGES)"
endef
## WHAT=search: of a search, and its largest step: STARTS= SEED=
define count-search
$(call begin,count-search)
$(call packages,build target clang)
$(call configure,$(BUILD),)
$(call compile,$(BUILD),search search_replay)
$(call configure,$(PPC),$(CROSS))
$(call compile,$(PPC),search_replay)
$(call configure,$(CLANG),$(FIXED_HOST))
$(call compile,$(CLANG),search search_replay)
$(call configure,$(PPC)-fixed,$(CROSS) $(FIXED))
$(call compile,$(PPC)-fixed,search_replay)
@ft/ppc603e/count-search $(BUILD) $(PPC) $(CLANG) $(PPC)-fixed $(or $(STARTS),24) $(or $(SEED),11)
endef
## WHAT=statistics: of 10000 estimates: median, 99th percentile, worst: FRAMES= SEED=
define count-statistics
$(call begin,count-statistics)
$(replays)
@ft/ppc603e/count $(BUILD) $(PPC) $(or $(FRAMES),10000) $(or $(SEED),1)
endef

# Without the rig; another board builds the same program with files of its own (docs/porting.md).
port-check: ## measure: what a port has to give, tried here: arithmetic, memory, stack, same bits, clock, slots: DIGEST= UNTIMED=1
	$(call packages,build test)
	$(call configure,$(BUILD),)
	$(call compile,$(BUILD),port_check)
	@$(BUILD)/ft/port/port_check $(if $(UNTIMED),--untimed) $(DIGEST)

# $(on_first_board) builds the first bare board's image in floating point and the rig around it, $(on_board) those of both number types, and the second
# board's. What the first one's stacks may hold make prove knows.
define on_first_board
$(call packages,build target)
$(call configure,$(BUILD),)
$(call compile,$(BUILD),pil_rig)
$(call configure,$(BOARD),$(FLIGHT_BOARD))
$(call compile,$(BOARD),flight_603e in_sensor_603e planted_603e)
endef
define on_board
$(on_first_board)
$(call packages,target-arm clang)
$(call configure,$(CLANG),$(FIXED_HOST))
$(call compile,$(CLANG),pil_rig)
$(call configure,$(BOARD)-fixed,$(FLIGHT_BOARD) $(FIXED))
$(call compile,$(BOARD)-fixed,flight_603e)
$(call configure,$(SECOND),$(SECOND_BOARD))
$(call compile,$(SECOND),flight_cortexa9 in_sensor_cortexa9 planted_cortexa9)
endef
FLOWN := $(call choice,pil,FLIGHT,full in_sensor sample upload)
pil: $(if $(filter upload,$(FLOWN))$(if $(ORDERED),$(filter sample,$(FLOWN))),,prove) ## board: the component on the bare 603e and Cortex-A9, camera and ground at their lines
	$(pil-$(FLOWN))

# $(call fly_boards[,in_sensor])
fly_boards = @ft/pil/run.py $(BUILD) $(BOARD) $(CLANG) $(BOARD)-fixed $(SECOND) $(or $(FRAMES),360) $(1)
## FLIGHT=full: on both boards and in both number types: FRAMES=
define pil-full
$(call begin,pil)
$(on_board)
$(call fly_boards)
endef
## FLIGHT=in_sensor: the image for a sensor's own processor, its head beside it, on the 603e: FRAMES=
define pil-in_sensor
$(call begin,pil-in_sensor)
$(on_first_board)
$(call fly_boards,in_sensor)
endef
## FLIGHT=sample: a few frames of each, and the answers of the boards to planted faults: a gate
define pil-sample
$(call begin,pil-sample)
$(if $(landing),$(on_first_board),$(on_board))
$(if $(landing),,$(call linked_image,$(BOARD),linked_603e))
@ft/pil/faults $(BUILD) $(BOARD) $(if $(landing),,$(CLANG) $(BOARD)-fixed $(SECOND))
endef
## FLIGHT=upload: a mission image over the line of the ground into the store of the 603e, and flown from there
define pil-upload
$(call begin,pil-upload)
$(call packages,build target)
$(call configure,$(BUILD),)
$(call compile,$(BUILD),pil_rig)
$(call configure,$(BOARD),$(FLIGHT_BOARD))
$(call compile,$(BOARD),flight_603e)
@ft/pil/upload $(BUILD) $(BOARD)
endef

# $(call proof,FOLDER[,CMAKE OPTIONS]) builds the flight image with its call graph: the one that make pil flies.
define proof
$(call configure,$(1),$(strip $(FLIGHT_BOARD) $(2)))
$(call compile,$(1),flight_603e in_sensor_603e)
@cfg/toolchains/take_call_graphs $(1)
$(call tidy,$(1),ci)
endef
prove: ## board: no heap, exceptions, recursion or contraction in the flight image; stacks and memory within budget
	$(begin)
	$(call packages,build target)
	$(if $(landing),,$(fixed_proof))
	$(call proof,$(BOARD))
	@cfg/quality/prove $(BOARD)

define fixed_proof
$(call proof,$(BOARD)-fixed,$(FIXED))
@echo "in fixed point"; LASSO_OUT=$(LASSO_OUT)/fixed-point cfg/quality/prove $(BOARD)-fixed
endef

ppc-test: ## board: unit tests of the flight component on the emulated 603e
	$(begin)
	$(call packages,build target)
	$(if $(landing),$(tests_on_target),$(all_on_target))

# All flight sources are compiled for the 603e at a landing, too: golden_replay links them.
define tests_on_target
$(call configure,$(PPC),$(CROSS))
$(call compile,$(PPC),golden_replay $(ON_TARGET))
@cfg/quality/run-tests ppc-test 603e=$(PPC) $(ON_TARGET)
endef
define all_on_target
$(if $(filter .,$(SOURCE)),$(call configure,$(BOARD),$(FLIGHT_BOARD)))
$(if $(filter .,$(SOURCE)),$(call compile,$(BOARD),bare_kernel))
$(call configure,$(PPC),$(CROSS))
$(call compile,$(PPC))
$(call configure,$(PPC)-fixed,$(CROSS) $(FIXED))
$(call compile,$(PPC)-fixed,$(PER_POINT))
@cfg/quality/run-tests ppc-test 603e=$(PPC) fixed=$(PPC)-fixed $(PER_POINT)
endef

sanitize mcdc: export UBSAN_OPTIONS := print_stacktrace=1
sanitize: ## gate: all tests in fixed point under the address and undefined sanitizers; threads under their own
	$(begin)
	$(call packages,build clang test stereo)
	$(call configure,$(SANITIZE)-address,$(call sanitized,address$(comma)undefined) $(FIXED))
	$(call compile,$(SANITIZE)-address)
	$(call configure,$(SANITIZE)-thread,$(call sanitized,thread) -DLASSO_GROUND=OFF)
	$(call compile,$(SANITIZE)-thread,$(THREADED))
	@cfg/quality/run-tests sanitize address,undefined=$(SANITIZE)-address thread=$(SANITIZE)-thread $(THREADED)

# $(page) builds the page of mdat serve into mdat/web/dist; an mdat that is compiled after it has it. What npm brings is kept until the lock file changes.
WEB = mdat/web
npm_ci = PLAYWRIGHT_SKIP_BROWSER_DOWNLOAD=1 npm ci --no-audit --no-fund --silent
define page
$(call packages,build web)
@cd $(WEB) && { cmp -s package-lock.json node_modules/.lock || { $(npm_ci) && cp package-lock.json node_modules/.lock; }; }
@cd $(WEB) && npm run --silent build
endef

page: ## gate: the page of mdat serve: lint, types, units, and each activity in Chromium, in both themes and by the keyboard alone
	$(begin)
	$(call packages,page)
	$(page)
	$(call configure,$(BUILD),)
	$(call compile,$(BUILD),mdat)
	@cfg/quality/page $(WEB) $(BUILD)

requirements: ## gate: the requirements are well formed, and the tests name them as they are now
	$(begin)
	$(call packages,trace)
	@reqs/requirements

arrows: ## gate: includes obey the arrows between rooms
	$(begin)
	$(call packages,lint)
	@cfg/quality/arrows

# Only fsw and hal_lcs are counted (a pattern that no shell takes apart). A test that ends in an invariant leaves its counts first (ut/support/main.cpp).
# $(call covered,TARGETS) builds them by g++ -O0 with counters, which change no value: make golden flies that build, too. Each source by itself: of two
# instances of a template in one object gcovr keeps the branches of one. GCC writes the folder of a build into its notes: the cache may not hand them to
# another.
coverage $(if $(landing),,golden): export CCACHE_BASEDIR :=
define covered
$(call configure,$(COVERAGE),-DCMAKE_BUILD_TYPE=Coverage -DLASSO_GROUND=OFF -DLASSO_UNITY=OFF \
  -DCMAKE_CXX_FLAGS="-O0 --coverage -fprofile-filter-files=/[fh][sa][wl] -fprofile-abs-path -fno-exceptions -DLASSO_BEFORE_ABORT=__gcov_dump")
$(call compile,$(COVERAGE),$(1))
endef
coverage: ## gate: unit tests take every line and branch of the flight component (gcovr)
	$(begin)
	$(call packages,build coverage)
	$(call covered,flight_tests)
	$(call tidy,$(COVERAGE),gcno)
	@find $(COVERAGE) -name '*.gcda' -delete; rm -rf $(LASSO_OUT)/coverage
	$(call ctest,$(COVERAGE),$(LASSO_OUT)/coverage/test,-L flight)
	@cfg/quality/coverage $(COVERAGE) $(SOURCE)

# $(call counted,TARGETS) builds them by clang++ with sanitizers and counters, which change no value: make golden flies that build, too.
define counted
$(call configure,$(MCDC),$(call sanitized,address$(comma)undefined) -DLASSO_GROUND=OFF -DLASSO_COUNT=ON)
$(call compile,$(MCDC),$(1))
endef
golden: export LLVM_PROFILE_FILE := /dev/null
mcdc: export LLVM_PROFILE_FILE := $(abspath $(MCDC))/profiles/%m.profraw
mcdc: ## gate: unit tests show that each condition decides by itself; address and undefined sanitizers
	$(begin)
	$(call packages,build coverage)
	$(call counted,flight_tests)
	@rm -rf $(MCDC)/profiles $(LASSO_OUT)/mcdc
	$(call ctest,$(MCDC),$(LASSO_OUT)/mcdc/test,-L flight)
	@cfg/quality/mcdc $(MCDC) $(SOURCE)

mutants: ## gate: 200 small changes to the flight sources: the unit tests find at least 95 %: COUNT= SEED=
	$(begin)
	$(call packages,build clang)
	@cfg/quality/mutants $(or $(COUNT),200) $(or $(SEED),1) $(SOURCE)

trace: ## gate: every active requirement has a passing test or its evidence; after test and ppc-test
	$(begin)
	$(call packages,trace)
	@reqs/trace $(if $(COMPLETE),--complete)

evidence: ## gate: collect what the gates left into out/evidence and docs/verification.md
	$(call packages,trace)
	@reqs/evidence

gates-selftest: ## gate: every gate fails on its planted violation
	$(begin)
	$(call packages,build target lint trace coverage web page)
	@cfg/quality/gates-selftest

inputs: ## gate: gates.toml names what the gates really read; after the gates
	$(begin)
	@cfg/quality/inputs

verify: ## gate: every gate in its whole form; goes on where it was, and writes the record by which .ci/run skips
	@cfg/quality/run-gates verify

WRITTEN := $(call choice,write,WHAT,generated icd hazards campaign-table figures)
write: ## write: pages and tables that programs write
	$(write-$(WRITTEN))

## WHAT=generated: icd, hazards and campaign-table: all that is made of sources
define write-generated
$(write-icd)
$(write-hazards)
$(write-campaign-table)
endef
## WHAT=icd: docs/icd/link.md and python/lasso_mdat/dictionary.json from the dictionary of packets, cfg/mission.schema.json from the rows of keys
define write-icd
$(call packages,build)
$(call configure,$(BUILD),)
$(call compile,$(BUILD),mdat)
@$(BUILD)/mdat/mdat dictionary >$(LASSO_OUT)/link.md && { cmp -s $(LASSO_OUT)/link.md docs/icd/link.md || mv $(LASSO_OUT)/link.md docs/icd/link.md; }
@$(BUILD)/mdat/mdat dictionary --format json | python/pack_dictionary >$(LASSO_OUT)/dictionary.json && { cmp -s $(LASSO_OUT)/dictionary.json python/lasso_mdat/dictionary.json || mv $(LASSO_OUT)/dictionary.json python/lasso_mdat/dictionary.json; }
@$(BUILD)/mdat/mdat mission schema >$(LASSO_OUT)/mission.schema.json && { cmp -s $(LASSO_OUT)/mission.schema.json cfg/mission.schema.json || mv $(LASSO_OUT)/mission.schema.json cfg/mission.schema.json; }
endef
## WHAT=hazards: docs/hazards.md from reqs/hazards.yaml and reqs/fmea.yaml
define write-hazards
$(call packages,trace)
@reqs/hazards
endef
## WHAT=campaign-table: the tables of the missions' campaigns of docs/campaigns.md
define write-campaign-table
$(call packages,build)
$(call configure,$(BUILD),)
$(call compile,$(BUILD),mdat)
@ft/campaign/table $(BUILD)
endef
## WHAT=figures: the measured figures of README.md, docs/benchmarks.md and docs/benchmark-protocol.md, from results in out/
define write-figures
@docs/figures
endef

format: ## write: format all tracked sources
	$(call packages,lint)
	@$(SOURCES) | xargs -0 clang-format -i

lint: ## gate: clang-format, clang-tidy and cppcheck find nothing: LINT=all reads all again
	$(begin)
	$(call packages,build clang lint target target-arm stereo)
	$(call configure,$(LINT),-DCMAKE_CXX_COMPILER=clang++-19 $(own_includes))
	$(call configure,$(LINT)-board,$(BARE_BOARD) -DLASSO_LINT=ON $(own_includes))
	$(call configure,$(LINT)-second,$(SECOND_BOARD) -DLASSO_LINT=ON $(own_includes))
	@for folder in $(LINT) $(LINT)-board $(LINT)-second; do ninja -C $$folder build.ninja >/dev/null || exit 1; done # new files
	@cfg/quality/lint $(LINT) . $(LINT)-board $(LINT)-second

# $(installed) builds what is installed.
define installed
$(call packages,build)
$(call configure,$(BUILD),)
$(call compile,$(BUILD),installed)
endef
install: ## first: install mdat, the shipped missions, the flight component and its CMake package: PREFIX= (/usr/local)
	$(installed)
	@cmake --install $(BUILD) --prefix "$$(realpath -m -- "$(PREFIX)")" >$(LASSO_OUT)/install.log || { cat $(LASSO_OUT)/install.log; false; }
	@echo "installed under $(PREFIX): $$(wc -l <$(BUILD)/install_manifest.txt) files"

package: ## first: Debian packages 3dlasso-mdat and 3dlasso-dev in out/package, each tried
	$(installed)
	$(call packages,package)
	@cfg/quality/package $(BUILD)

clean: ## first: remove everything that was built (out/)
	@rm -rf out

build: ## first: build everything of the host into out/build
	$(call packages,build)
	$(call configure,$(BUILD),)
	$(call compile,$(BUILD))
