// SPDX-License-Identifier: BSD-3-Clause
// Pointers, wheel and keys on a plan: drag pans, with the right button or in the oblique view with Shift it turns; two
// fingers zoom; a click selects a robot; while measuring, a drag measures.

class PlanGestures {
  /** repaint: for all plans that share the camera; status: describes the thing under the pointer. */
  constructor(view, session, {repaint, status, measuring}) {
    Object.assign(this, {view, session, camera: view.camera, repaint, status, measuring});
    this.pointers = new Map();
    this.moved = false;
    const release = (event) => this.release(event);
    setProperties(view.surface.canvas, {
      onpointerdown: (event) => this.press(event),
      onpointermove: (event) => this.move(event),
      onpointerup: release,
      onpointercancel: release,
      onpointerleave: () => status(""),
      onwheel: (event) => this.wheel(event),
      oncontextmenu: (event) => event.preventDefault(),
      ondblclick: (event) => this.doubleClick(event),
      onkeydown: (event) => this.key(event)
    });
  }

  press(event) {
    const at = this.view.surface.place(event),
      canvas = this.view.surface.canvas;
    canvas.setPointerCapture(event.pointerId);
    this.pointers.set(event.pointerId, at);
    this.moved = false;
    if (this.measuring() && event.button === 0) {
      const place = this.camera.place(at.x, at.y);
      this.view.measure = {from: place, to: place};
      this.repaint();
    }
  }

  move(event) {
    const at = this.view.surface.place(event),
      before = this.pointers.get(event.pointerId);
    if (!before) {
      this.status(this.view.textAt(at.x, at.y));
      return;
    }
    if (!this.moved && Math.hypot(at.x - before.x, at.y - before.y) < 4) return;
    this.moved = true;
    if (this.measuring() && this.pointers.size === 1 && this.view.measure) {
      this.view.measure.to = this.camera.place(at.x, at.y);
      this.status(measureText(this.view.measure));
    } else if (this.pointers.size === 2) this.pinch(event.pointerId, before, at);
    else if (event.buttons & 2 || (event.shiftKey && this.camera.oblique)) this.turn(at.x - before.x, at.y - before.y);
    else {
      this.leave();
      this.camera.pan(at.x - before.x, at.y - before.y);
    }
    this.pointers.set(event.pointerId, at);
    this.repaint();
  }

  /** Two fingers: their distance is the scale, their middle stays where it is on the floor. */
  pinch(moving, before, at) {
    const other = [...this.pointers].find(([id]) => id !== moving)[1];
    const middle = (point) => ({x: (point.x + other.x) / 2, y: (point.y + other.y) / 2});
    const was = middle(before),
      is = middle(at);
    this.leave();
    this.camera.pan(is.x - was.x, is.y - was.y);
    this.camera.zoom(
      Math.hypot(at.x - other.x, at.y - other.y) / Math.max(1, Math.hypot(before.x - other.x, before.y - other.y)),
      is.x,
      is.y
    );
  }

  turn(across, down) {
    if (!this.camera.oblique) return;
    this.camera.turn += across * 0.008;
    this.camera.tilt = Math.max(0.25, Math.min(1.45, this.camera.tilt + down * 0.006));
    this.camera.update();
  }

  release(event) {
    const at = this.view.surface.place(event),
      pressed = this.pointers.delete(event.pointerId);
    if (!pressed || this.moved || event.type === "pointercancel" || event.button !== 0 || this.measuring()) return;
    const robot = this.view.robotAt(at.x, at.y);
    if (event.shiftKey) {
      // A place for an intervention.
      this.session.place = this.camera.place(at.x, at.y);
      this.session.changed("place");
    } else if (robot >= 0) this.session.selectRobot(robot);
  }

  wheel(event) {
    event.preventDefault();
    const at = this.view.surface.place(event);
    // Followed, the robot stays in the middle; else the place under the pointer stays where it is.
    const {x, y} = this.session.following ? {x: this.camera.width / 2, y: this.camera.height / 2} : at;
    this.camera.fitted = false;
    this.camera.zoom(2 ** (-wheelPixels(event) / 240), x, y);
    this.repaint();
  }

  doubleClick(event) {
    const at = this.view.surface.place(event),
      robot = this.view.robotAt(at.x, at.y);
    if (robot >= 0) {
      this.session.selectRobot(robot);
      this.session.follow(true);
    } else this.view.fit();
    this.repaint();
  }

  key(event) {
    const pan = {ArrowLeft: [60, 0], ArrowRight: [-60, 0], ArrowUp: [0, 60], ArrowDown: [0, -60]}[event.key];
    const zoom = {"+": 1.25, "=": 1.25, "-": 0.8, _: 0.8}[event.key];
    if ((!pan && !zoom && event.key !== "0") || event.ctrlKey || event.metaKey || event.altKey) return;
    if (pan) {
      this.leave();
      this.camera.pan(...pan);
    } else if (zoom) {
      this.camera.fitted = false;
      this.camera.zoom(zoom, this.camera.width / 2, this.camera.height / 2);
    } else this.view.fit();
    event.preventDefault();
    event.stopPropagation();
    this.repaint();
  }

  /** A camera that is moved by hand follows no robot. */
  leave() {
    this.camera.fitted = false;
    if (this.session.following) this.session.follow(false);
  }
}

/** A wheel's movement in pixels, whatever unit it has. */
function wheelPixels(event) {
  return event.deltaY * (event.deltaMode === 1 ? 20 : event.deltaMode === 2 ? 400 : 1);
}
