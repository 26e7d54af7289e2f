// SPDX-License-Identifier: BSD-3-Clause
//
// locks CASE [safe]: a lost update, a lost wake-up and crossed locks with parking_lot's mutexes; correct with a second word.
use parking_lot::{Condvar, Mutex};
use std::sync::Arc;
use std::thread;

fn add(balance: &Mutex<i32>, is_safe: bool) {
    if is_safe {
        *balance.lock() += 1;
        return;
    }
    let seen = *balance.lock();
    *balance.lock() = seen + 1;
}

fn update(is_safe: bool) {
    let balance = Arc::new(Mutex::new(0));
    let other = balance.clone();
    let adding = thread::spawn(move || add(&other, is_safe));
    add(&balance, is_safe);
    adding.join().unwrap();
    assert_eq!(*balance.lock(), 2);
}

fn wake_up(is_safe: bool) {
    let state = Arc::new((Mutex::new(false), Condvar::new()));
    let other = state.clone();
    let giving = thread::spawn(move || {
        *other.0.lock() = true;
        other.1.notify_one();
    });
    if is_safe {
        let mut ready = state.0.lock();
        while !*ready {
            state.1.wait(&mut ready);
        }
    } else if !*state.0.lock() {
        state.1.wait(&mut state.0.lock());
    }
    giving.join().unwrap();
}

fn take_both(first: &Mutex<i32>, second: &Mutex<i32>) {
    let mut one = first.lock();
    let mut two = second.lock();
    *one += 1;
    *two += 1;
}

fn crossed(is_safe: bool) {
    let locks = Arc::new((Mutex::new(0), Mutex::new(0)));
    let other = locks.clone();
    let taking = thread::spawn(move || take_both(&other.0, &other.1));
    if is_safe {
        take_both(&locks.0, &locks.1);
    } else {
        take_both(&locks.1, &locks.0);
    }
    taking.join().unwrap();
}

fn main() {
    let words: Vec<String> = std::env::args().collect();
    let is_safe = words.len() > 2;
    match words[1].as_str() {
        "update" => update(is_safe),
        "wake-up" => wake_up(is_safe),
        _ => crossed(is_safe),
    }
}
