// SPDX-License-Identifier: BSD-3-Clause
// Foxglove's own client of its WebSocket protocol reads a run of the program that WAITPOINT_PROGRAM names.
import assert from 'node:assert/strict';
import {spawn} from 'node:child_process';
import {once} from 'node:events';
import {test} from 'node:test';
import {fileURLToPath} from 'node:url';
import path from 'node:path';
import protocol from '@foxglove/ws-protocol';
import {WebSocket} from 'ws';

const {FoxgloveClient} = protocol,
  program = process.env.WAITPOINT_PROGRAM,
  skip = program ? false : 'WAITPOINT_PROGRAM names no program';
const scenario = path.resolve(path.dirname(fileURLToPath(import.meta.url)), '../../scenarios/office.yaml');

/** The first address of Foxglove that a served run prints. */
async function addressOf(run) {
  let said = '';
  for await (const data of run.stderr) {
    said += data;
    const found = /ws:\/\/\S+\/foxglove\?token=\w+(?=\s)/.exec(said);
    if (found) return found[0];
  }
  throw new Error(said);
}

/** Collects what a client hears. */
function listen(address) {
  const client = new FoxgloveClient({ws: new WebSocket(address, [FoxgloveClient.SUPPORTED_SUBPROTOCOL])}),
    heard = {channels: new Map(), messages: new Map(), times: [], statuses: [], errors: []};
  client.on('serverInfo', (info) => (heard.info = info));
  client.on('advertise', (channels) => channels.forEach((channel) => heard.channels.set(channel.topic, channel)));
  client.on('status', (status) => heard.statuses.push(status));
  client.on('error', (error) => heard.errors.push(error));
  client.on('time', ({timestamp}) => heard.times.push(timestamp));
  client.on('message', ({subscriptionId, timestamp, data}) => {
    const message = {logTime: timestamp, ...JSON.parse(new TextDecoder().decode(data))};
    heard.messages.set(subscriptionId, [...(heard.messages.get(subscriptionId) ?? []), message]);
  });
  return {client, heard};
}

async function until(condition) {
  for (let i = 0; !condition(); ++i) {
    assert.ok(i < 1000, 'in 20 s');
    await new Promise((resolve) => setTimeout(resolve, 20));
  }
}

test('a run is read while it goes and when it is over', {skip}, async () => {
  const run = spawn(program, ['run', scenario, '--until', '4', '--speed', '2', '--serve'], {
    stdio: ['ignore', 'ignore', 'pipe']
  });
  const address = await addressOf(run);
  try {
    const {client, heard} = listen(address);
    await until(() => heard.channels.size > 0);
    assert.deepEqual(heard.info.capabilities, ['time']);
    const scans = client.subscribe(heard.channels.get('/rackham/laser').id),
      world = client.subscribe(heard.channels.get('/world').id);
    await until(() => heard.messages.get(scans)?.length >= 5 && heard.messages.has(world));
    client.unsubscribe(scans);
    const [first, second] = heard.messages.get(scans).slice(-2);
    assert.ok(first.logTime < second.logTime && heard.times.includes(second.logTime));
    assert.equal(second.ranges.length, 361);
    assert.equal(second.frame_id, 'rackham/laser');
    assert.ok(heard.messages.get(world)[0].entities[0].cubes.length > 10);
    await until(() => heard.statuses.some(({message}) => message.startsWith('the run is over')));
    const late = listen(address);
    await until(() => late.heard.channels.has('/rackham/goals'));
    const frames = late.client.subscribe(late.heard.channels.get('/tf').id);
    await until(() => late.heard.messages.get(frames)?.length === 3);
    late.client.subscribe(999);
    await until(() => late.heard.statuses.length > 0);
    assert.match(late.heard.statuses[0].message, /there is no channel 999/);
    assert.deepEqual([...heard.errors, ...late.heard.errors], []);
    client.close();
    late.client.close();
  } finally {
    run.kill('SIGINT');
    await once(run, 'exit');
  }
});
