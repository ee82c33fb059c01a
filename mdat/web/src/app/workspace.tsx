// A recording's workspace: the head, the views in their places with lines between them to drag, and the time line at the foot.
import { effect } from "@preact/signals";
import { useEffect } from "preact/hooks";
import { sentence } from "../maths/scales.ts";
import { IconButton } from "../parts/controls.tsx";
import { Icon } from "../parts/icon.tsx";
import { Splitter } from "../parts/splitter.tsx";
import { LiveBar } from "../views/live/live_bar.tsx";
import { CommonTools } from "./common_tools.tsx";
import { openOverlay } from "./overlay.ts";
import { remembered } from "./remembered.ts";
import { noteFrame, routeTo } from "./route.ts";
import type { Session } from "./session.ts";
import { type Place, VIEWS } from "./views.ts";

/** Sizes of views in thirteenths of a rem: they grow with the text. */
const sideWidth = remembered("side-width", 380);
const plotsHeight = remembered("plots-height", 200);
const eventsHeight = remembered("events-height", 190);
const firstVisit = remembered("first-visit", true);

/** The cursor moves 25 times a second: more costs a software renderer what scans need. */
const TICK_MS = 40;

/** Lets the clock drive the player, and the address follow the frame. */
function useClock(session: Session): void {
  useEffect(() => {
    let last = 0;
    let request = 0;
    const tick = (now: number) => {
      if (!session.player.playing.peek()) return;
      request = requestAnimationFrame(tick);
      if (last > 0 && now - last < TICK_MS) return;
      if (last > 0) session.player.advance(Math.min(0.25, (now - last) / 1000));
      last = now;
    };
    const stopPlaying = effect(() => {
      cancelAnimationFrame(request);
      last = 0;
      if (session.player.playing.value) request = requestAnimationFrame(tick);
    });
    const stopNoting = effect(() => {
      const frame = session.selection.frame.value;
      if (!session.player.playing.value && !session.selection.following.value) noteFrame(session.log.info.id, session.log.number(frame));
    });
    return () => {
      cancelAnimationFrame(request);
      stopPlaying();
      stopNoting();
    };
  }, [session]);
}

function Head({ session }: { session: Session }) {
  const { info } = session.log;
  const { canUndo, canRedo } = session.history;
  return (
    <header class="head">
      <a class="brand" href={routeTo(null)} title="All recordings">
        <Icon name="home" />
        <span>MDAT</span>
      </a>
      <h1 title={info.name}>{info.name}</h1>
      <p class="run">
        {[
          info.mission?.replace(/^.*\//, "").replace(/\.toml$/, ""),
          info.scenario,
          info.sensor,
          info.seed === null ? "" : `seed ${info.seed}`,
          session.log.frames === 1 ? "1 frame" : `${session.log.frames} frames`,
        ]
          .filter(Boolean)
          .join(" · ")}
      </p>
      <div class="head-tools">
        <IconButton
          icon="undo"
          label={canUndo.value === null ? "Nothing to undo" : `Undo: ${canUndo.value}`}
          stroke="Ctrl+z"
          disabled={canUndo.value === null}
          onClick={() => session.history.undo()}
        />
        <IconButton
          icon="redo"
          label={canRedo.value === null ? "Nothing to do again" : `Do again: ${canRedo.value}`}
          stroke="Ctrl+Shift+z"
          disabled={canRedo.value === null}
          onClick={() => session.history.redo()}
        />
        <button type="button" class="text-button" onClick={() => openOverlay("command")}>
          <Icon name="command" /> Command
        </button>
        <CommonTools />
      </div>
    </header>
  );
}

/** What a file cannot tell, where the user would look for it. */
function Damage({ session }: { session: Session }) {
  const { damage } = session.log.info;
  if (damage.length === 0) return null;
  return (
    <div class="banner" role="status">
      <Icon name="warning" />
      <span>
        <strong>This recording is damaged.</strong> What is whole of it is shown. {damage.map(sentence).join(" ")}
      </span>
    </div>
  );
}

function endFirstVisit(): void {
  firstVisit.value = false;
}

/** Three lines on the first visit on what can be done next. */
function FirstSteps() {
  if (!firstVisit.value) return null;
  return (
    <aside class="first-steps" aria-label="First steps">
      <ol>
        <li>Space plays, arrow keys go by frames, W jumps to the next wrong pose.</li>
        <li>Drag in a plot for a span's statistics; P plots another value.</li>
        <li>“Why” explains each frame. Press ? for all keys.</li>
      </ol>
      <IconButton icon="close" label="Close the first steps" onClick={endFirstVisit} />
    </aside>
  );
}

function Views({ place }: { place: Place }) {
  return (
    <>
      {VIEWS.filter((entry) => entry.place === place).map((entry) => (
        <entry.view key={entry.id} />
      ))}
    </>
  );
}

export function Workspace({ session }: { session: Session }) {
  useClock(session);
  const size = (thirteenths: number) => `${(thirteenths / 13).toFixed(3)}rem`;
  const sizes = { "--side": size(sideWidth.value), "--plots": size(plotsHeight.value), "--events": size(eventsHeight.value) };
  return (
    <div class="workspace" style={sizes}>
      <Head session={session} />
      <FirstSteps />
      <Damage session={session} />
      <LiveBar session={session} />
      <main class="views">
        <div class="place place-main">
          <Views place="main" />
        </div>
        <Splitter label="Width of the side" axis="x" size={sideWidth} least={280} most={720} />
        <div class="place place-side">
          <Views place="side-top" />
          <Splitter label="Height of the events" axis="y" size={eventsHeight} least={96} most={640} />
          <Views place="side-bottom" />
        </div>
        <Splitter label="Height of the plots" axis="y" size={plotsHeight} least={120} most={900} />
        <div class="place place-bottom">
          <Views place="bottom" />
        </div>
        <div class="place place-foot">
          <Views place="foot" />
        </div>
      </main>
    </div>
  );
}
