// SPDX-License-Identifier: BSD-3-Clause
//
// locks CASE [safe]: a lost update, a lost wake-up and crossed locks of crossbeam; correct with a second word.
use crossbeam::atomic::AtomicCell;
use crossbeam::sync::{Parker, ShardedLock};
use std::sync::Arc;
use std::thread;

fn add(balance: &AtomicCell<i32>, is_safe: bool) {
    if is_safe {
        balance.fetch_add(1);
    } else {
        balance.store(balance.load() + 1);
    }
}

fn update(is_safe: bool) {
    let balance = Arc::new(AtomicCell::new(0));
    let other = balance.clone();
    let adding = thread::spawn(move || add(&other, is_safe));
    add(&balance, is_safe);
    adding.join().unwrap();
    assert_eq!(balance.load(), 2);
}

// The waiter checks the flag after each wake-up: it must be set before.
fn wake_up(is_safe: bool) {
    let flag = Arc::new(AtomicCell::new(false));
    let parker = Parker::new();
    let (other, unparker) = (flag.clone(), parker.unparker().clone());
    let giving = thread::spawn(move || {
        if is_safe {
            other.store(true);
            unparker.unpark();
        } else {
            unparker.unpark();
            other.store(true);
        }
    });
    while !flag.load() {
        parker.park();
    }
    giving.join().unwrap();
}

fn take_both(first: &ShardedLock<i32>, second: &ShardedLock<i32>) {
    let mut one = first.write().unwrap();
    let mut two = second.write().unwrap();
    *one += 1;
    *two += 1;
}

fn crossed(is_safe: bool) {
    let locks = Arc::new((ShardedLock::new(0), ShardedLock::new(0)));
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
