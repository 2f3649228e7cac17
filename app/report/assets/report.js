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

  function showMoment(event, time) {
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

  function shadeUntilConverged(canvas, area, graph) {
    if (data.converged === null) return;
    const right = Math.min(graph.toDomXCoord(data.converged), area.x + area.w);
    if (right <= area.x) return;
    canvas.fillStyle = colour('pause');
    canvas.fillRect(area.x, area.y, right - area.x, area.h);
  }

  // Draws bands where the status is not tracking: low ones for uncertain, high ones for lost.
  function drawStatus(canvas, area, graph) {
    shadeUntilConverged(canvas, area, graph);
    data.pathTime.forEach(function (t, i) {
      if (data.status[i] === 0) return;
      const next = i + 1 < data.pathTime.length ? data.pathTime[i + 1] : t;
      const until = next - t > data.longestPathStep ? t : next;
      const left = Math.max(graph.toDomXCoord(t), area.x);
      const right = Math.min(Math.max(graph.toDomXCoord(until), graph.toDomXCoord(t) + 1), area.x + area.w);
      if (right <= left) return;
      const height = data.status[i] === 2 ? area.h : area.h / 3;
      canvas.fillStyle = colour(data.statusNames[data.status[i]]);
      canvas.globalAlpha = 0.6;
      canvas.fillRect(left, area.y + area.h - height, right - left, height);
      canvas.globalAlpha = 1;
    });
  }

  function qualityInWords(value, time) {
    const i = lastUpTo(data.pathTime, time + 1e-6);
    if (i < 0) return value.toFixed(3);
    return value.toFixed(3) + ', ' + data.statusNames[data.status[i]] + ': ' + data.reasonNames[data.reason[i]];
  }

  const all = data.time.concat(data.samplesTime, data.pathTime);
  const range = [Math.min(...data.time.slice(0, 1), ...data.samplesTime.slice(0, 1), 0),
                 Math.max(...data.time.slice(-1), ...data.samplesTime.slice(-1), ...data.pathTime.slice(-1), 0.001)];
  const graphs = [];

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

  function schemeOptions(names) {
    return { colors: names.map(colour), axisLineColor: colour('line'), gridLineColor: colour('line') };
  }

  function chart(id, rows, labels, colourNames, options) {
    const element = document.getElementById(id);
    if (!element || all.length === 0) return;
    const graph = new Dygraph(element, rows, Object.assign(schemeOptions(colourNames), {
      labels: labels, dateWindow: range, includeZero: true, strokeWidth: 1.5, gridLineWidth: 1,
      legend: 'follow', highlightCircleSize: 3, xlabel: 'time [s]', underlayCallback: shadeUntilConverged,
      highlightCallback: showMoment, unhighlightCallback: hideMoment,
      axes: { x: { valueFormatter: function (t) { return t.toFixed(2) + ' s'; } } }
    }, options));
    graphs.push(graph);
    matchMedia('(prefers-color-scheme: dark)').addEventListener('change', function () {
      graph.updateOptions(schemeOptions(colourNames));
    });
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
  function errorChart(id, unit, values, sigmas, bounds) {
    const top = topAfterConvergence(values, sigmas);
    const hasBounds = bounds.length > 0;
    const rows = data.time.map(function (t, i) {
      return [t, sigmas[i], values[i]].concat(hasBounds ? [bounds[i]] : []);
    });
    const names = ['time', '1 sigma', 'error'].concat(hasBounds ? ['lower bound'] : []);
    chart(id, withGaps(rows, data.longestStep), names, ['sigma', 'estimate'].concat(hasBounds ? ['samples'] : []), {
      ylabel: 'error [' + unit + ']', valueRange: [0, top],
      series: { '1 sigma': { fillGraph: true, strokeWidth: 0.5 } }
    });
  }

  errorChart('position', 'm', data.position, data.positionSigma, data.positionBound);
  errorChart('heading', 'deg', data.heading, data.headingSigma, data.headingBound);
  const qualities = data.pathTime.map(function (t, i) { return [t, data.quality[i]]; });
  chart('quality', withGaps(qualities, data.longestPathStep), ['time', 'quality'], ['ink'], {
    ylabel: 'quality', valueRange: [0, 1.05], underlayCallback: drawStatus,
    axes: { x: { valueFormatter: function (t) { return t.toFixed(2) + ' s'; } },
            y: { valueFormatter: function (value, opts, name, graph, row) {
              return qualityInWords(value, graph.getValue(row, 0));
            } } }
  });
  const samples = data.samplesTime.map(function (t, i) { return [t, data.samples[i]]; });
  const counts = data.samples.filter(function (n) { return n > 0; });
  chart('samples', withGaps(samples, data.longestSamplesStep), ['time', 'samples'], ['samples'], {
    ylabel: 'samples', stepPlot: true, logscale: true, includeZero: false,
    valueRange: counts.length === 0 ? null : [Math.min(...counts) / 1.5, 1.5 * Math.max(...counts)]
  });
  if (graphs.length > 1) Dygraph.synchronize(graphs, { range: false });
})();
