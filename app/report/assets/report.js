(function () {
  'use strict';
  const data = JSON.parse(document.getElementById('data').textContent);

  // Returns a colour of report.css in the reader's light or dark scheme.
  function colour(name) {
    return getComputedStyle(document.documentElement).getPropertyValue('--' + name).trim();
  }

  function place(id, x, y) {
    const mark = document.getElementById(id);
    if (x === null || y === null) return;
    mark.setAttribute('cx', x);
    mark.setAttribute('cy', y);
    mark.setAttribute('visibility', 'visible');
  }

  // Returns the index of the last element of the sorted list that is not above the value.
  function lastUpTo(list, value) {
    let low = 0;
    let high = list.length;
    while (low < high) {
      const middle = (low + high) >> 1;
      if (list[middle] <= value) low = middle + 1; else high = middle;
    }
    return low - 1;
  }

  function showMoment(time) {
    const i = lastUpTo(data.time, time + 1e-6);
    if (i < 0) return;
    place('truth-now', data.truthX[i], data.truthY[i]);
    place('estimate-now', data.estimateX[i], data.estimateY[i]);
  }

  function hideMoment() {
    for (const id of ['truth-now', 'estimate-now']) {
      document.getElementById(id).setAttribute('visibility', 'hidden');
    }
  }

  // Fills the chart between two times and from the bottom up to a share of its height.
  function fillBetween(chart, from, until, share, paint) {
    const { ctx, bbox } = chart;
    const left = Math.max(Math.round(from), bbox.left);
    const right = Math.min(Math.round(until), bbox.left + bbox.width);
    if (right <= left) return;
    ctx.fillStyle = paint;
    ctx.fillRect(left, bbox.top + bbox.height * (1 - share), right - left, bbox.height * share);
  }

  function shadeUntilConverged(chart) {
    if (data.converged === null) return;
    fillBetween(chart, -Infinity, chart.valToPos(data.converged, 'x', true), 1, colour('pause'));
  }

  // Draws bands where the status is not tracking: low ones for uncertain, high ones for lost.
  function drawStatus(chart) {
    shadeUntilConverged(chart);
    const paints = data.statusNames.map(colour);
    chart.ctx.globalAlpha = 0.6;
    const { pathTime, status } = data;
    const hasNext = function (i) { return i + 1 < pathTime.length && pathTime[i + 1] - pathTime[i] <= data.longestPathStep; };
    for (let first = 0, last = 0; first < pathTime.length; first = last = last + 1) {
      while (hasNext(last) && status[last + 1] === status[first]) ++last;
      if (status[first] === 0) continue;
      const left = chart.valToPos(pathTime[first], 'x', true);
      const right = chart.valToPos(pathTime[hasNext(last) ? last + 1 : last], 'x', true);
      fillBetween(chart, left, Math.max(right, left + 2), status[first] === 2 ? 1 : 1 / 3, paints[status[first]]);
    }
    chart.ctx.globalAlpha = 1;
  }

  function qualityInWords(value, time) {
    const i = lastUpTo(data.pathTime, time + 1e-6);
    if (i < 0) return value.toFixed(3);
    return value.toFixed(3) + ', ' + data.statusNames[data.status[i]] + ': ' + data.reasonNames[data.reason[i]];
  }

  const all = data.time.concat(data.samplesTime, data.pathTime);
  const range = [Math.min(...data.time.slice(0, 1), ...data.samplesTime.slice(0, 1), 0),
                 Math.max(...data.time.slice(-1), ...data.samplesTime.slice(-1), ...data.pathTime.slice(-1), 0.001)];
  const charts = [];

  // Returns the rows with empty ones in gaps over which no line is drawn.
  function withGaps(rows, longestStep) {
    const out = [];
    rows.forEach(function (row, i) {
      if (i > 0 && row[0] - rows[i - 1][0] > longestStep) {
        out.push([(row[0] + rows[i - 1][0]) / 2].concat(row.slice(1).map(function () { return null; })));
      }
      out.push(row);
    });
    return out;
  }

  // Returns the indices of points between gaps, which no line shows; null without any.
  function isolatedPoints(chart, index) {
    const values = chart.data[index];
    const isEmpty = function (i) { return (values[i] ?? null) === null; };
    const found = [];
    for (let i = 0; i < values.length; ++i) {
      if (!isEmpty(i) && isEmpty(i - 1) && isEmpty(i + 1)) found.push(i);
    }
    return found.length > 0 ? found : null;
  }

  function axis(name, options) {
    const font = '12px system-ui, "Segoe UI", "DejaVu Sans", sans-serif';
    const line = { stroke: function () { return colour('line'); }, width: 1 };
    return Object.assign({
      label: name, labelSize: 18, labelGap: 0, gap: 3, font: font, labelFont: font,
      stroke: function () { return colour('muted'); }, grid: line, ticks: Object.assign({ size: 4 }, line),
      values: function (chart, ticks) { return ticks.map(function (t) { return String(Number(t.toPrecision(6))); }); }
    }, options);
  }

  // Moves the time that charts show, as long as the button is down.
  function move(chart, start) {
    const { min, max } = chart.scales.x;
    const perPixel = (max - min) / chart.over.clientWidth;
    const follow = function (event) {
      const shift = (start.clientX - event.clientX) * perPixel;
      chart.setScale('x', { min: min + shift, max: max + shift });
    };
    document.addEventListener('mousemove', follow);
    document.addEventListener('mouseup', function () { document.removeEventListener('mousemove', follow); }, { once: true });
  }

  // Returns how a line is drawn and how its values are written above the chart.
  function seriesOf(line) {
    const paint = function () { return colour(line.colour); };
    return Object.assign({
      label: line.label, width: 1.5, stroke: paint,
      points: { show: false, filter: isolatedPoints, size: 4, fill: paint },
      value: function (chart, value, index, i) { return value === null ? '\u2013' : line.write(value, chart.data[0][i]); }
    }, line.options);
  }

  // Returns what the pointer does: zoom along one axis at a time, move, and show everything; all charts have its time.
  function cursorOptions(showAll) {
    return {
      y: false, drag: { x: true, y: true, uni: Infinity, dist: 5 },
      sync: { key: 'time', scales: ['x', null], filters: { pub: function (type) { return type === 'mousemove'; } } },
      bind: {
        mousedown: function (chart, target, handle) {
          return function (event) {
            if (event.button === 0) event.shiftKey ? move(chart, event) : handle(event);
          };
        },
        dblclick: function (chart) { return function () { showAll(chart); }; }
      }
    };
  }

  function showRobot(chart) {
    if (!chart.cursor.event) return; // the pointer is over another chart
    const i = chart.cursor.idx;
    if (i === null) hideMoment(); else showMoment(chart.data[0][i]);
  }

  // Has all charts show the times that one shows.
  function zoomOthers(chart, key) {
    if (key !== 'x') return;
    const { min, max } = chart.scales.x;
    for (const other of charts) {
      if (other.scales.x.min !== min || other.scales.x.max !== max) other.setScale('x', { min: min, max: max });
    }
  }

  // Draws a chart of rows of a time and a value for each of the lines: label, colour, how its values are written, and
  // options of uPlot. The values' axis has the name and the range; what is drawn below all lines is the last argument.
  function drawChart(id, rows, lines, name, scale, valueAxis, drawBelow) {
    const element = document.getElementById(id);
    if (!element || all.length === 0) return;
    let legend = null;
    let hasOwnRange = false; // whether the reader has chosen a range of values
    const showAll = function (chart) {
      hasOwnRange = false;
      chart.setScale('x', { min: range[0], max: range[1] });
    };
    const noteRange = function (chart) {
      if (chart.select.height < chart.over.clientHeight - 1) hasOwnRange = true;
    };
    const time = { label: 'time', value: function (chart, t) { return t === null ? '\u2013' : t.toFixed(2) + ' s'; } };
    const columns = [time].concat(lines).map(function (column, i) { return rows.map(function (row) { return row[i]; }); });
    const chart = new uPlot({
      width: 160, height: 100, padding: [6, 12, 0, 0], series: [time].concat(lines.map(seriesOf)),
      scales: {
        x: { time: false, min: range[0], max: range[1] },
        y: Object.assign({ auto: function () { return !hasOwnRange; } }, scale)
      },
      axes: [axis('time [s]', { size: 22 }), axis(name, Object.assign({ size: 50 }, valueAxis))],
      legend: {
        mount: function (chart, table) {
          legend = table;
          element.append(table);
        },
        markers: { width: 0, fill: function (chart, i) { return 'var(--' + lines[i - 1].colour + ')'; } }
      },
      cursor: cursorOptions(showAll),
      hooks: { drawClear: [drawBelow], setCursor: [showRobot], setSelect: [noteRange], setScale: [zoomOthers] }
    }, columns, element);
    charts.push(chart);
    new ResizeObserver(function () {
      chart.setSize({ width: Math.max(element.clientWidth, 160), height: element.clientHeight - legend.offsetHeight });
    }).observe(element);
    matchMedia('(prefers-color-scheme: dark)').addEventListener('change', function () { chart.redraw(false); });
  }

  // Returns the top of an error's axis; errors before convergence would flatten all others.
  function topAfterConvergence(values, sigmas) {
    if (data.converged === null) return null;
    let top = 0;
    data.time.forEach(function (t, i) {
      if (t >= data.converged) top = Math.max(top, values[i], Math.min(sigmas[i] || 0, 3 * values[i]));
    });
    return top > 0 ? 1.15 * top : null;
  }

  // Draws a chart of errors. Bounds are Cramer-Rao bounds; empty if they were not requested.
  function errorChart(id, unit, digits, values, sigmas, bounds) {
    const top = topAfterConvergence(values, sigmas);
    const hasBounds = bounds.length > 0;
    const rows = data.time.map(function (t, i) {
      return [t, sigmas[i], values[i]].concat(hasBounds ? [bounds[i]] : []);
    });
    const write = function (value) { return value.toFixed(digits) + ' ' + unit; };
    const lines = [
      { label: '1 sigma', colour: 'sigma', write: write,
        options: { width: 0.5, fill: function () { return colour('area'); } } },
      { label: 'error', colour: 'estimate', write: write }
    ].concat(hasBounds ? [{ label: 'lower bound', colour: 'samples', write: write }] : []);
    const scale = { range: function (chart, low, high) { return [0, top ?? (high > 0 ? 1.05 * high : 1)]; } };
    drawChart(id, withGaps(rows, data.longestStep), lines, 'error [' + unit + ']', scale, {}, shadeUntilConverged);
  }

  // Returns 1, 2 and 5 times the powers of ten in a range; more of them in a short one, powers alone in a long one.
  function logarithmicTicks(chart, axisIndex, low, high) {
    const factors = high > 1000 * low ? [1] : high > 20 * low ? [1, 2, 5] : [1, 2, 3, 5, 7];
    const ticks = [];
    for (let power = Math.pow(10, Math.floor(Math.log10(low))); power <= high; power *= 10) {
      for (const factor of factors) {
        if (factor * power >= low && factor * power <= high) ticks.push(factor * power);
      }
    }
    return ticks;
  }

  errorChart('position', 'm', 3, data.position, data.positionSigma, data.positionBound);
  errorChart('heading', 'deg', 2, data.heading, data.headingSigma, data.headingBound);
  const qualities = data.pathTime.map(function (t, i) { return [t, data.quality[i]]; });
  drawChart('quality', withGaps(qualities, data.longestPathStep),
            [{ label: 'quality', colour: 'ink', write: qualityInWords }],
            'quality', { range: function () { return [0, 1.05]; } }, {}, drawStatus);
  const samples = data.samplesTime.map(function (t, i) { return [t, data.samples[i] > 0 ? data.samples[i] : null]; });
  const counts = data.samples.filter(function (n) { return n > 0; });
  const countRange = counts.length === 0 ? [1, 10] : [Math.min(...counts) / 1.5, 1.5 * Math.max(...counts)];
  drawChart('samples', withGaps(samples, data.longestSamplesStep),
            [{ label: 'samples', colour: 'samples', write: String, options: { paths: uPlot.paths.stepped({ align: 1 }) } }],
            'samples', { distr: 3, range: function () { return countRange; } },
            { splits: logarithmicTicks, filter: function (chart, ticks) { return ticks; } }, shadeUntilConverged);
})();
