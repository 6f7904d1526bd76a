// What pointers, wheel and keys ask of a chart: to zoom, to pan, to show a job. The page scrolls as it would without.

const DRAG_PX = 4;
const WHEEL_ZOOM = 0.008;
const LINE_PX = 16;
const KEY_ZOOM = 1.5;

/** Tells `asked` of them: {zoom(factor, x), pan(px), whole(), hover({x, y} | null), pick({x, y}), key(name)}, in pixels
 *  from the left top of `surface`; each gives back whether something came of it. `frame` has the focus for keys. */
export function listen(frame, surface, asked) {
  const gone = new AbortController();
  const { signal } = gone;
  const on = (target, type, handle) => target.addEventListener(type, handle, { signal, passive: false });
  listenToPointers(surface, on, asked);
  on(surface, "dblclick", () => asked.whole());
  on(surface, "wheel", (event) => turned(event, surface, asked) && event.preventDefault());
  on(document, "keydown", (event) => event.key === "Escape" && asked.hover(null));
  on(frame, "keydown", (event) => pressed(event, asked) && event.preventDefault());
  return () => gone.abort();
}

function listenToPointers(surface, on, asked) {
  const down = new Map();
  let dragged = false;
  on(surface, "pointerdown", (event) => {
    if (event.button !== 0) return;
    if (!down.size) dragged = false;
    down.set(event.pointerId, pointOf(event, surface));
  });
  on(surface, "pointermove", (event) => {
    const before = down.get(event.pointerId);
    const now = pointOf(event, surface);
    if (!before) {
      if (event.pointerType !== "touch") asked.hover(now);
      return;
    }
    if (!dragged && down.size === 1 && Math.abs(now.x - before.x) < DRAG_PX) return;
    if (!dragged) surface.setPointerCapture(event.pointerId);
    dragged = true;
    asked.hover(null);
    const other = [...down].find(([id]) => id !== event.pointerId)?.[1];
    if (other) asked.zoom(distance(before, other) / distance(now, other), (now.x + other.x) / 2);
    asked.pan((before.x - now.x) / down.size);
    down.set(event.pointerId, now);
  });
  const up = (event) => {
    if (down.delete(event.pointerId) && !dragged && event.type === "pointerup") asked.pick(pointOf(event, surface));
  };
  on(surface, "pointerup", up);
  on(surface, "pointercancel", up);
  on(surface, "pointerleave", () => asked.hover(null));
}

function pointOf(event, surface) {
  const box = surface.getBoundingClientRect();
  return { x: event.clientX - box.left, y: event.clientY - box.top };
}

function distance(one, other) {
  return Math.max(Math.hypot(one.x - other.x, one.y - other.y), 10);
}

function turned(event, surface, asked) {
  const unit = event.deltaMode === WheelEvent.DOM_DELTA_LINE ? LINE_PX : 1;
  if (event.ctrlKey) {
    const turn = Math.min(Math.max(event.deltaY * unit, -100), 100);
    asked.zoom(Math.exp(turn * WHEEL_ZOOM), pointOf(event, surface).x);
    return true;
  }
  const across = event.shiftKey && !event.deltaX ? event.deltaY : event.deltaX;
  const sideways = event.shiftKey || Math.abs(event.deltaX) > Math.abs(event.deltaY);
  return sideways && asked.pan(across * unit);
}

function pressed(event, asked) {
  if (event.ctrlKey || event.altKey || event.metaKey) return false;
  if (event.key === "+" || event.key === "=") return asked.zoom(1 / KEY_ZOOM, null);
  if (event.key === "-") return asked.zoom(KEY_ZOOM, null);
  if (event.key === "0") return asked.whole();
  return asked.key(event.shiftKey && event.key.startsWith("Arrow") ? `Shift${event.key}` : event.key);
}
