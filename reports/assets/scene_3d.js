/* Moving 3-D views of trials, opened by a click. A view is an element of class "scene-3d" whose data
   attributes name the elements that hold its models and its motion (binary glTF in base64), the camera
   (eye, target in the world's frame, vertical field of view) and the instant of its picture.
   Nothing is fetched, and no text becomes markup. */
(function () {
  'use strict';

  var KEY_TIME = 1 / 30;       // of an arrow key [s]
  var LONGEST_ARROW = 0.045;   // [m]
  var CONE_LENGTH = 0.018;     // [m]
  var SPOKES = 10;
  var COLOURS = { point: 0x0d0d0d, failed: 0xd90099, force: 0xcc1f05, stick: 0x0d6b14, slide: 0x0d29bf };

  var opened = null;           // one view at a time has a WebGL context
  var models = {};             // promises, by the element's id

  function make(tag, className, text) {
    var element = document.createElement(tag);
    if (className) element.className = className;
    if (text) element.textContent = text;
    return element;
  }

  function parseGlb(id) {
    var text = atob(document.getElementById(id).textContent.trim());
    var bytes = new Uint8Array(text.length);
    for (var i = 0; i < text.length; i++) bytes[i] = text.charCodeAt(i);
    return new Promise(function (resolve, reject) {
      new THREE.GLTFLoader().parse(bytes.buffer, '', resolve, reject);
    });
  }

  function loadModel(id) {
    if (!models[id]) models[id] = parseGlb(id);
    return models[id];
  }

  /* Hangs the meshes of a model below the nodes of the same part. */
  function dress(scene, model) {
    var nodes = {};
    scene.traverse(function (node) {
      if (node.userData.part !== undefined) nodes[node.userData.part] = node;
    });
    model.scene.children.forEach(function (mesh) {
      var node = nodes[mesh.userData.part];
      var copy = mesh.clone();
      copy.userData = {};
      if (node) node.add(copy);
    });
  }

  function unitCone() {
    var points = [];
    for (var i = 0; i < SPOKES; i++) {
      var a = 2 * Math.PI * i / SPOKES, b = 2 * Math.PI * (i + 1) / SPOKES;
      points.push(0, 0, 0, Math.cos(a), Math.sin(a), 1);
      points.push(Math.cos(a), Math.sin(a), 1, Math.cos(b), Math.sin(b), 1);
    }
    var geometry = new THREE.BufferGeometry();
    geometry.setAttribute('position', new THREE.Float32BufferAttribute(points, 3));
    return geometry;
  }

  /* Contact points, forces that end there, friction cones; drawn over all else. */
  function Marks(parent, contacts, failed) {
    this.failed = failed;  // links
    this.group = new THREE.Group();
    parent.add(this.group);
    this.contacts = contacts;
    this.items = [];
    this.withForces = this.withCones = true;
    var units = contacts.units, largest = 0;
    this.keys = contacts.keys.map(function (key) {
      return key.map(function (c) {
        var force = new THREE.Vector3(c[7], c[8], c[9]).multiplyScalar(units.force_n);
        largest = Math.max(largest, force.length());
        return {
          link: c[0], force: force, mu: c[10], state: contacts.states[c[11]],
          p: new THREE.Vector3(c[1], c[2], c[3]).multiplyScalar(units.xyz_m),
          n: new THREE.Vector3(c[4], c[5], c[6]).normalize()
        };
      });
    });
    this.scale = largest > 0 ? LONGEST_ARROW / largest : 0;
    this.shapes = {
      ball: new THREE.SphereBufferGeometry(0.0015, 12, 8),
      shaft: new THREE.CylinderBufferGeometry(0.001, 0.001, 1, 8).translate(0, -0.5, 0),
      head: new THREE.ConeBufferGeometry(0.0026, 0.007, 12).translate(0, -0.0035, 0),
      cone: unitCone()
    };
    function material(Type, colour) {
      return new Type({ color: new THREE.Color(colour).convertSRGBToLinear(), depthTest: false,
        transparent: true });
    }
    this.paints = {
      point: material(THREE.MeshBasicMaterial, COLOURS.point),
      failed: material(THREE.MeshBasicMaterial, COLOURS.failed),
      force: material(THREE.MeshBasicMaterial, COLOURS.force),
      stick: material(THREE.LineBasicMaterial, COLOURS.stick),
      slide: material(THREE.LineBasicMaterial, COLOURS.slide)
    };
  }

  Marks.prototype.addItem = function () {
    var s = this.shapes, p = this.paints;
    var item = {
      root: new THREE.Group(), arrow: new THREE.Group(), ball: new THREE.Mesh(s.ball, p.point),
      shaft: new THREE.Mesh(s.shaft, p.force),
      cone: new THREE.LineSegments(s.cone, p.stick)
    };
    item.arrow.add(item.shaft, new THREE.Mesh(s.head, p.force));
    item.root.add(item.ball, item.arrow, item.cone);
    item.root.traverse(function (node) { node.renderOrder = 1; });
    this.group.add(item.root);
    this.items.push(item);
  };

  Marks.prototype.show = function (key) {
    var contacts = this.keys[key];
    while (this.items.length < contacts.length) this.addItem();
    var up = new THREE.Vector3(0, 1, 0), ahead = new THREE.Vector3(0, 0, 1);
    for (var i = 0; i < this.items.length; i++) {
      var item = this.items[i], c = contacts[i];
      item.root.visible = !!c;
      if (!c) continue;
      item.root.position.copy(c.p);
      var hasFailed = this.failed.indexOf(String(c.link)) >= 0;
      item.ball.material = hasFailed ? this.paints.failed : this.paints.point;
      item.ball.scale.setScalar(hasFailed ? 2.5 : 1);
      var length = c.force.length();
      item.arrow.visible = this.withForces && length > 0;
      if (item.arrow.visible) {
        item.arrow.quaternion.setFromUnitVectors(up, c.force.clone().divideScalar(length));
        item.shaft.scale.y = Math.max(length * this.scale, 1e-6);
      }
      item.cone.visible = this.withCones && c.mu > 0;
      var half = Math.atan(c.mu), rim = CONE_LENGTH * Math.sin(half);
      item.cone.scale.set(rim, rim, CONE_LENGTH * Math.cos(half));
      item.cone.quaternion.setFromUnitVectors(ahead, c.n.clone().negate());
      item.cone.material = c.state === 'slides' ? this.paints.slide : this.paints.stick;
    }
    return contacts;
  };

  function View(root) {
    this.root = root;
    this.stage = root.querySelector('.stage');
    this.time = Number(root.dataset.time);
    this.playing = false;
    this.button = make('button', 'open-3d', 'Show in 3-D');
    this.button.type = 'button';
    this.button.addEventListener('click', this.open.bind(this));
    this.stage.appendChild(this.button);
    this.cursors = [].slice.call(root.querySelectorAll('.cursor'));
    root.addEventListener('click', this.goWhere.bind(this));
  }

  /* A click on a curve or a phase: the view opens and goes there. */
  View.prototype.goWhere = function (event) {
    var plot = event.target.closest && event.target.closest('svg.plot');
    var cursor = plot && plot.querySelector('.cursor');
    if (!cursor || this.button.hidden) return;
    var box = plot.getBoundingClientRect();
    var x = (event.clientX - box.left) * plot.viewBox.baseVal.width / box.width;
    var share = (x - Number(cursor.dataset.left)) / Number(cursor.dataset.width);
    var from = Number(cursor.dataset.from), to = Number(cursor.dataset.to);
    var time = from + share * (to - from);
    if (this.renderer) return this.show(time);
    this.time = time;
    this.open();
  };

  View.prototype.open = function () {
    if (opened === this) return;
    if (opened) opened.close();
    opened = this;
    var self = this, data = this.root.dataset;
    this.button.disabled = true;
    Promise.all([parseGlb(data.motion), loadModel(data.hand), loadModel(data.object)])
      .then(function (parts) { if (opened === self) self.start(parts[0], parts[1], parts[2]); })
      .catch(function () { self.refuse(); });
  };

  View.prototype.refuse = function () {
    if (this.renderer) this.close();
    if (opened === this) opened = null;
    this.button.hidden = true;
    this.stage.appendChild(
      make('p', 'refusal', 'This browser cannot draw in 3-D; picture, table and curves stay.'));
  };

  View.prototype.start = function (motion, hand, object) {
    var camera = this.root.dataset.camera.split(' ').map(Number);
    this.renderer = new THREE.WebGLRenderer({ antialias: true, alpha: true });
    this.renderer.gammaOutput = true;
    this.renderer.setPixelRatio(Math.min(window.devicePixelRatio || 1, 2));
    this.scene = new THREE.Scene();
    dress(motion.scene, hand);
    dress(motion.scene, object);
    this.scene.add(motion.scene);
    this.scene.add(new THREE.HemisphereLight(0xffffff, 0x606870, 0.55));
    var sun = new THREE.DirectionalLight(0xffffff, 0.45);
    sun.position.set(-0.5, 1, 0.4);
    this.scene.add(sun);
    this.scene.add(new THREE.GridHelper(1, 20, 0x808890, 0xa0a8b0));
    this.camera = new THREE.PerspectiveCamera(camera[6] * 180 / Math.PI, 4 / 3, 0.01, 10);
    this.camera.position.set(camera[0], camera[2], -camera[1]);  // glTF has y up
    var extras = motion.scene.userData;
    this.extras = extras;
    this.end = extras.times_s[extras.times_s.length - 1];
    this.marks = new Marks(motion.scene.children[0], extras.contacts,
                           (this.root.dataset.failed || '').split(' '));
    if (motion.animations.length > 0) {
      this.mixer = new THREE.AnimationMixer(motion.scene);
      this.action = this.mixer.clipAction(motion.animations[0]);
      this.action.setLoop(THREE.LoopOnce, 1);
      this.action.clampWhenFinished = true;
      this.action.play();
    }

    this.canvas = this.renderer.domElement;
    this.canvas.tabIndex = 0;
    this.canvas.setAttribute('role', 'img');
    this.canvas.setAttribute('aria-label', this.root.dataset.label);
    this.stage.appendChild(this.canvas);
    this.controls = new THREE.OrbitControls(this.camera, this.canvas);
    this.controls.enableKeys = false;
    this.controls.target.set(camera[3], camera[5], -camera[4]);
    this.controls.update();
    this.controls.addEventListener('change', this.draw.bind(this));
    this.root.classList.add('open');
    this.addPanel();
    this.listen();
    this.resize();
    this.show(this.time);
    this.canvas.focus({ preventScroll: true });
  };

  View.prototype.addPanel = function () {
    var self = this;
    var panel = make('div', 'panel');
    this.playButton = make('button', '', 'Play');
    this.playButton.type = 'button';
    this.playButton.addEventListener('click', this.toggle.bind(this));
    this.slider = make('input');
    this.slider.type = 'range';
    this.slider.min = 0;
    this.slider.max = this.end;
    this.slider.step = 'any';
    this.slider.setAttribute('aria-label', 'time');
    this.slider.addEventListener('input', function () { self.show(Number(self.slider.value)); });
    var track = make('div', 'track');
    track.appendChild(this.slider);
    this.extras.phases.forEach(function (phase) {
      var mark = make('span', 'phase-mark');
      mark.style.left = 100 * phase.time_s / self.end + '%';
      track.appendChild(mark);
    });
    panel.appendChild(this.playButton);
    panel.appendChild(track);
    this.panel = make('div', 'controls');
    this.panel.appendChild(panel);

    var phases = make('div', 'panel');
    this.extras.phases.forEach(function (phase) {
      var jump = make('button', 'small', phase.name + ' ' + phase.time_s.toFixed(2) + ' s');
      jump.type = 'button';
      jump.addEventListener('click', function () { self.show(phase.time_s); });
      phases.appendChild(jump);
    });
    [['forces', 'withForces'], ['friction cones', 'withCones']].forEach(function (choice) {
      var label = make('label', 'small'), box = make('input');
      box.type = 'checkbox';
      box.checked = true;
      box.addEventListener('change', function () {
        self.marks[choice[1]] = box.checked;
        self.show(self.time);
      });
      label.appendChild(box);
      label.appendChild(document.createTextNode(' ' + choice[0]));
      phases.appendChild(label);
    });
    var close = make('button', 'small', 'Close');
    close.type = 'button';
    close.addEventListener('click', this.close.bind(this));
    phases.appendChild(close);
    this.panel.appendChild(phases);
    this.words = make('output', 'small');
    this.panel.appendChild(this.words);
    this.panel.appendChild(make('p', 'small',
      'Drag to turn, wheel to zoom, right button to move. Space plays, arrow keys step, Home and End ' +
      'jump. Drawn over the bodies, red arrow: force on the object; green cone: stands still, blue cone: ' +
      'slides; magenta point: the contact that failed.'));
    this.stage.parentNode.insertBefore(this.panel, this.stage.nextSibling);
  };

  View.prototype.listen = function () {
    var self = this;
    this.onKey = function (event) {
      var steps = { ArrowRight: KEY_TIME, ArrowUp: KEY_TIME, ArrowLeft: -KEY_TIME, ArrowDown: -KEY_TIME,
        PageUp: 0.5, PageDown: -0.5, Home: -Infinity, End: Infinity };
      var tag = event.target.tagName;
      if (event.ctrlKey || event.altKey || event.metaKey) return;
      if (event.key === ' ' && tag !== 'BUTTON' && event.target.type !== 'checkbox') {
        self.toggle();
      } else if (steps[event.key] !== undefined &&
                 (event.target === self.canvas || event.target === self.slider)) {
        self.pause();
        self.show(self.time + steps[event.key]);
      } else {
        return;
      }
      event.preventDefault();
    };
    this.root.addEventListener('keydown', this.onKey);
    this.onResize = this.resize.bind(this);
    window.addEventListener('resize', this.onResize);
  };

  View.prototype.resize = function () {
    var width = this.stage.clientWidth, height = Math.round(0.75 * width);
    this.renderer.setSize(width, height);
    this.camera.aspect = width / height;
    this.camera.updateProjectionMatrix();
    this.draw();
  };

  View.prototype.draw = function () { this.renderer.render(this.scene, this.camera); };

  View.prototype.findKey = function (time) {
    var times = this.extras.times_s, key = 0;
    while (key + 1 < times.length && times[key + 1] <= time + 1e-6) key++;
    return key;
  };

  View.prototype.findPhase = function (time) {
    var name = '';
    this.extras.phases.forEach(function (phase) { if (phase.time_s <= time + 1e-6) name = phase.name; });
    return name;
  };

  View.prototype.show = function (time) {
    this.time = Math.min(Math.max(time, 0), this.end);
    if (this.mixer) {
      this.action.enabled = true;
      this.action.paused = false;
      this.action.time = this.time;
      this.mixer.update(0);
    }
    var contacts = this.marks.show(this.findKey(this.time));
    var normal = contacts.reduce(function (sum, c) { return sum + Math.max(c.force.dot(c.n), 0); }, 0);
    function count(state) { return contacts.filter(function (c) { return c.state === state; }).length; }
    var sliding = count('slides'), atLimit = count('at its limit');
    var words = this.time.toFixed(2) + ' s, ' + this.findPhase(this.time) + ': ' + contacts.length +
      (contacts.length === 1 ? ' contact' : ' contacts') + (sliding ? ', ' + sliding + ' sliding' : '') +
      (atLimit ? ', ' + atLimit + ' at the limit of friction' : '') +
      ', ' + normal.toFixed(2) + ' N normal to the object';
    this.words.textContent = words;
    this.slider.value = this.time;
    this.slider.setAttribute('aria-valuetext', words);
    var at = this.time;
    this.cursors.forEach(function (cursor) {
      var from = Number(cursor.dataset.from), to = Number(cursor.dataset.to);
      var x = Number(cursor.dataset.left) + Number(cursor.dataset.width) * (at - from) / (to - from);
      cursor.setAttribute('x1', x);
      cursor.setAttribute('x2', x);
    });
    this.draw();
  };

  View.prototype.toggle = function () { this.playing ? this.pause() : this.play(); };

  View.prototype.pause = function () {
    this.playing = false;
    this.playButton.textContent = 'Play';
  };

  View.prototype.play = function () {
    var self = this, last = null;
    if (this.time >= this.end) this.show(0);
    this.playing = true;
    this.playButton.textContent = 'Pause';
    function step(now) {
      if (!self.playing) return;
      if (last !== null) self.show(self.time + (now - last) / 1000);
      last = now;
      if (self.time >= self.end) return self.pause();
      window.requestAnimationFrame(step);
    }
    window.requestAnimationFrame(step);
  };

  View.prototype.close = function () {
    this.playing = false;
    if (this.panel) this.panel.remove();
    if (this.controls) this.controls.dispose();
    if (this.renderer) {
      this.canvas.remove();
      this.renderer.dispose();
      this.renderer.forceContextLoss();
    }
    this.root.removeEventListener('keydown', this.onKey);
    window.removeEventListener('resize', this.onResize);
    this.renderer = this.controls = this.panel = this.mixer = null;
    this.root.classList.remove('open');
    this.button.disabled = false;
    if (opened === this) opened = null;
  };

  var views = {};
  [].forEach.call(document.querySelectorAll('.scene-3d'), function (root) {
    views[root.id] = new View(root);
  });
  /* A link to a view opens it. */
  function followHash() {
    var view = views[window.location.hash.slice(1)];
    if (!view) return;
    for (var node = view.root; node; node = node.parentNode) {
      if (node.tagName === 'DETAILS') node.open = true;
    }
    view.open();
  }
  window.addEventListener('hashchange', followHash);
  followHash();
})();
