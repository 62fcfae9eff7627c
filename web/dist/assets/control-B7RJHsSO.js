import{C as e,a as t,b as n,d as r,i,m as a,n as o,o as s,p as c,r as l,t as u,u as d,x as f}from"./index-B5g3GHyC.js";import{n as p,r as m,t as h}from"./hold-CpDyNk5i.js";import{t as g}from"./tab-BkMu52L1.js";import"./curves-Bn3Q-yc1.js";import{t as _}from"./axis-picker-xQ5SLATQ.js";var v=class extends g{static properties={...g.properties,axis:{type:String}};watches=[`status`];#e=null;static styles=[c,p,e`
      .panel {
        display: flex;
        flex-direction: column;
        gap: 8px;
        height: 100%;
      }
      .panel.error {
        border-color: var(--error);
      }
      .name {
        font-size: 16px;
        font-weight: 700;
      }
      .position {
        font-size: 30px;
        font-weight: 600;
        line-height: 1.1;
        text-align: right;
        font-variant-numeric: tabular-nums;
      }
      .unit {
        color: var(--muted);
        font-size: 12px;
        font-weight: 400;
      }
      dl {
        display: grid;
        grid-template-columns: repeat(2, auto 1fr);
        gap: 2px 8px;
        margin: 0;
      }
      dt {
        color: var(--muted);
        font-size: 12px;
        line-height: 20px;
      }
      dd {
        margin: 0;
        text-align: right;
        font-variant-numeric: tabular-nums;
      }
      .lamps {
        display: flex;
        flex-wrap: wrap;
        gap: 4px 14px;
      }
      .error-line {
        display: flex;
        align-items: center;
        gap: 8px;
        min-height: 26px;
        font-size: 13px;
      }
      .jog {
        display: grid;
        grid-template-columns: 1fr auto 1fr;
        gap: 8px;
      }
      .jog button {
        min-height: 38px;
      }
      details {
        font-size: 13px;
      }
      summary {
        color: var(--muted);
        font-size: 12px;
        cursor: pointer;
      }
      ul {
        display: grid;
        grid-template-columns: repeat(auto-fill, minmax(140px, 1fr));
        gap: 1px 10px;
        margin: 6px 0 0;
        padding: 0;
        list-style: none;
      }
      .set {
        display: grid;
        grid-template-columns: 1fr auto;
        gap: 6px;
        margin-top: 6px;
        align-items: end;
      }
    `];render(){let e=this.live.status?.axes[this.axis];if(!e)return f`<section class="panel"><span class="name">${this.axis}</span> –</section>`;let t=e=>this.catalog.actions.includes(e),r=this.axis;return f`
      <section class="panel ${e.error?`error`:``}" aria-label="Axis ${r}">
        <div class="row">
          <span class="name">${r}</span>
          <span class="badge ${u(e)}" data-role="state">${e.state}</span>
          ${e.loop_state&&e.loop_state!==`NA`?f`<span class="badge" title="StepNLoop">${e.loop_state}</span>`:n}
          <span class="grow"></span>
          ${t(`power`)&&e.enabled!==null?f`<button class="small" aria-pressed=${e.enabled} ?disabled=${!this.usable}
                @click=${()=>this.#a({do:`power`,axis:r,on:!e.enabled})}>
                motor ${e.enabled?`on`:`off`}
              </button>`:n}
        </div>
        <div class="position" data-role="position">
          ${l(e.position)} <span class="unit">${this.catalog.units.position}</span>
        </div>
        ${this.#t(e)}
        <div class="lamps">
          ${h(`−L`,e.negative_limit,`negative limit`,!0)}
          ${h(`Home`,e.home,`home switch`)}
          ${h(`+L`,e.positive_limit,`positive limit`,!0)}
          ${h(`Z`,e.index,`encoder index`)}
        </div>
        <div class="error-line">
          ${e.error?f`<strong class="error-text grow">⚠ ${e.error}</strong>`:f`<span class="muted grow">no error</span>`}
          ${t(`clear_error`)?f`<button class="small" ?disabled=${!this.usable||!e.error}
                @click=${()=>this.#a({do:`clear_error`,axis:r})}>Clear</button>`:n}
        </div>
        <div class="jog">
          <pt-hold .disabled=${!this.usable} .label=${`Jog ${r} in negative direction while pressed`}
            @begin=${()=>this.#o(-1)} @end=${()=>this.#e?.end()}>◀ −</pt-hold>
          <button ?disabled=${!this.reachable} aria-label="Stop ${r}" title="Stop with deceleration"
            @click=${this.#s}>■</button>
          <pt-hold .disabled=${!this.usable} .label=${`Jog ${r} in positive direction while pressed`}
            @begin=${()=>this.#o(1)} @end=${()=>this.#e?.end()}>+ ▶</pt-hold>
        </div>
        ${this.#n(e)} ${this.#r(t)}
      </section>
    `}#t(e){let{units:t}=this.catalog,n=[[`Speed`,e.speed,t.speed],[`Target`,e.target,t.position],[`Encoder`,e.encoder,t.encoder],[`Delta`,e.delta,t.encoder],[`Load`,e.load,``]].filter(([e,t])=>t!==null||e===`Target`||e===`Encoder`);return f`
      <dl>
        ${n.map(([e,t,n])=>f`<dt title=${n}>${e}</dt><dd data-role=${e.toLowerCase()}>${l(t)}</dd>`)}
      </dl>
    `}#n(e){return this.catalog.status_bits.length===0?n:f`
      <details>
        <summary>Status bits · ${e.flags.join(`, `)||`none set`}</summary>
        <ul>
          ${this.catalog.status_bits.map(({name:t,text:n,kind:r})=>f`<li>${h(t,e.flags.includes(t),n||t,r===`error`)}</li>`)}
        </ul>
      </details>
    `}#r(e){let t=[{action:`set_position`,label:`Position counter`,reset:`RP`},{action:`set_encoder`,label:`Encoder counter`,reset:`RE`}].filter(({action:t})=>e(t));return t.length===0?n:f`
      <details>
        <summary>Set counters</summary>
        ${t.map(({action:e,label:t})=>f`
            <form class="set" @submit=${t=>this.#i(t,e)}>
              <label>${t}<input name="value" class="number" type="text" inputmode="numeric" value="0" autocomplete="off" /></label>
              <button ?disabled=${!this.usable}>Set</button>
            </form>
          `)}
      </details>
    `}#i(e,t){e.preventDefault();let n=s(String(new FormData(e.target).get(`value`)));n===null?r(`A counter takes a whole number.`,`error`):this.#a({do:t,axis:this.axis,value:n})}#a(e){return d(()=>this.api.act(this.device.name,e))}#o(e){this.#e??=new m(this.api,this.live,this.axis),this.#e.begin(e)}#s(){this.locked?d(()=>this.api.stop(this.device.name)):this.#a({do:`stop`,axis:this.axis})}};customElements.define(`pt-axis`,v);var y=class extends g{static properties={...g.properties,axis:{state:!0},mode:{state:!0}};static styles=[c,e`
      .panel {
        height: 100%;
      }
      .about {
        min-height: 2.8em;
        font-size: 13px;
        color: var(--muted);
      }
    `];willUpdate(e){super.willUpdate(e),e.has(`catalog`)&&(this.axis=this.catalog.axes[0]??``,this.mode=this.catalog.homing[0]?.id??0)}render(){let{homing:e,axes:t}=this.catalog,r=e.find(({id:e})=>e===this.mode);return f`
      <section class="panel stack" aria-label="Home">
        <div class="row"><h2 class="grow">Home</h2>
          ${_(t,this.axis,`home-axis`,e=>this.axis=e)}
        </div>
        <label>Mode
          <select @change=${e=>this.mode=Number(e.target.value)}>
            ${e.map(({id:e,name:t})=>f`<option value=${e} ?selected=${e===this.mode}>${e} · ${t}</option>`)}
          </select>
        </label>
        <p class="about">${r?.text}${r?.section?f` <span>(manual, ${r.section})</span>`:n}</p>
        <div class="row">
          ${[`-`,`+`].map(e=>r?.directions.includes(e)?f`<button class="grow" ?disabled=${!this.usable}
                  aria-label="Home ${this.axis} in ${e===`+`?`positive`:`negative`} direction"
                  @click=${()=>this.#e(e===`+`?1:-1)}>
                  ${e===`-`?`◀ Home −`:`Home + ▶`}
                </button>`:n)}
        </div>
      </section>
    `}#e(e){let{axis:t,mode:n}=this;d(()=>this.api.act(this.device.name,{do:`home`,axis:t,mode:n,direction:e}))}};customElements.define(`pt-homing`,y);var b=class extends g{static properties={...g.properties,chosen:{state:!0},relative:{state:!0}};watches=[`status`];static styles=[c,e`
      .panel {
        height: 100%;
      }
      .targets {
        display: grid;
        grid-template-columns: auto minmax(0, 1fr);
        gap: 6px 10px;
        align-items: center;
      }
      .mode {
        display: inline-flex;
      }
      .mode button:first-child {
        border-radius: var(--radius) 0 0 var(--radius);
      }
      .mode button:last-child {
        margin-left: -1px;
        border-radius: 0 var(--radius) var(--radius) 0;
      }
      .head {
        justify-content: space-between;
      }
    `];constructor(){super(),this.chosen=new Set,this.relative=!1}willUpdate(e){super.willUpdate(e),e.has(`catalog`)&&(this.chosen=new Set(this.catalog.axes.slice(0,1)))}get#e(){let e=this.live.status?.absolute;return typeof e==`boolean`?!e:this.relative}render(){let{axes:e}=this.catalog,t=this.#e,r=this.chosen.size>1;return f`
      <form class="panel stack" @submit=${this.#r}>
        <div class="row head">
          <h2>Move</h2>
          <div class="mode" role="group" aria-label="Move mode">
            <button type="button" class="small" aria-pressed=${!t} ?disabled=${!this.usable}
              title="Targets are positions" @click=${()=>this.#n(!1)}>ABS</button>
            <button type="button" class="small" aria-pressed=${t} ?disabled=${!this.usable}
              title="Targets are distances" @click=${()=>this.#n(!0)}>INC</button>
          </div>
        </div>
        <div class="targets">
          ${e.map(r=>f`
              <label class="line">
                ${e.length>1?f`<input type="checkbox" aria-label="Move axis ${r}" .checked=${this.chosen.has(r)}
                      @change=${e=>this.#t(r,e.target.checked)} />`:n}
                <strong>${r}</strong>
              </label>
              <input name=${r} class="number" type="text" inputmode="numeric" value="0" autocomplete="off"
                aria-label="${t?`Distance`:`Target`} of axis ${r} in ${this.catalog.units.position}" />
            `)}
        </div>
        <div class="row">
          <button class="primary grow" ?disabled=${!this.usable||this.chosen.size===0}>
            ${r?`Move ${[...this.chosen].join(`, `)} together`:t?`Move by`:`Move to`}
          </button>
          <button type="button" ?disabled=${!this.usable||this.chosen.size===0} title="Move to position 0"
            @click=${this.#i}>Return to 0</button>
        </div>
        <div class="row">
          <button type="button" class="grow" ?disabled=${!this.reachable} title="With deceleration"
            @click=${()=>d(()=>this.api.stop(this.device.name))}>Stop all axes</button>
          ${this.catalog.actions.includes(`abort`)?f`<button type="button" class="danger grow" ?disabled=${!this.usable} title="At once, without deceleration"
                @click=${()=>d(()=>this.api.act(this.device.name,{do:`abort`}))}>Abort</button>`:n}
        </div>
      </form>
    `}#t(e,t){this.chosen=new Set(this.catalog.axes.filter(n=>n===e?t:this.chosen.has(n)))}#n(e){this.relative=e,this.catalog.actions.includes(`set_mode`)&&d(()=>this.api.act(this.device.name,{do:`set_mode`,absolute:!e}))}#r(e){e.preventDefault();let t=new FormData(e.target),n={};for(let e of this.chosen){let i=s(String(t.get(e)));if(i===null){r(`The target of axis ${e} is not a whole number.`,`error`);return}n[e]=i}this.#a(n,this.#e)}#i(){this.#a(Object.fromEntries([...this.chosen].map(e=>[e,0])),!1)}#a(e,t){d(()=>this.api.act(this.device.name,{do:`move`,targets:e,relative:t}))}};customElements.define(`pt-moves`,b);var x=class extends g{static properties={...g.properties,axis:{state:!0}};static styles=[c,e`
      .panel {
        height: 100%;
      }
      .fields {
        display: flex;
        flex-wrap: wrap;
        gap: 8px;
      }
      .fields label {
        flex: 1;
        min-width: 60px;
      }
      .fields button {
        align-self: flex-end;
        min-width: 96px;
      }
    `];willUpdate(e){super.willUpdate(e),e.has(`catalog`)&&(this.axis=this.catalog.axes[0]??``)}render(){let{actions:e,axes:t,parameters:r,speed_windows:i,units:a}=this.catalog,o=r.find(({role:e,axis:t})=>e===`speed_window`&&t===this.axis)?.id;return f`
      <div class="panel stack">
        <div class="row"><h2 class="grow">On the fly</h2>
          ${_(t,this.axis,`fly-axis`,e=>this.axis=e)}
        </div>
        ${o===void 0?n:f`<form class="fields" @submit=${e=>this.#e(e,o)}>
              <label title="Both speeds have to lie in it; it can be set while the motor stands">Speed window (pps)
                <select name="window">
                  <option value="0">0 · no changes</option>
                  ${i.map(({number:e,from_pps:t,to_pps:n})=>f`
                    <option value=${e}>${e} · ${l(t)} to ${l(n)}</option>`)}
                </select>
              </label>
              <button ?disabled=${!this.usable}>Set ${o}</button>
            </form>`}
        ${e.includes(`change_speed`)?f`<form class="fields" @submit=${this.#t}>
              <label title=${a.speed}>Speed <input name="speed" class="number" type="text" inputmode="numeric" value="1000" /></label>
              <label title="empty: as it is">Accel <input name="acceleration" class="number" type="text" inputmode="numeric" /></label>
              <button ?disabled=${!this.usable}>Set speed</button>
            </form>`:n}
        ${e.includes(`change_target`)?f`<form class="fields" @submit=${this.#n}>
              <label title=${a.position}>Target <input name="target" class="number" type="text" inputmode="numeric" value="1000" /></label>
              <button ?disabled=${!this.usable}>Set target</button>
            </form>`:n}
      </div>
    `}#e(e,t){e.preventDefault();let n=Number(new FormData(e.target).get(`window`));d(()=>this.api.setParameter(this.device.name,t,n),`${t} is ${n}`)}#t(e){e.preventDefault();let t=new FormData(e.target),n={};for(let e of[`speed`,`acceleration`]){let i=String(t.get(e)??``).trim();if(i===``&&e!==`speed`)continue;let a=s(i);if(a===null){r(`“${i}” is not a whole number.`,`error`);return}n[e]=a}let{axis:i}=this;d(()=>this.api.act(this.device.name,{do:`change_speed`,axis:i,speed:n.speed,...n}))}#n(e){e.preventDefault();let t=s(String(new FormData(e.target).get(`target`)));t===null?r(`A target is a whole number.`,`error`):d(()=>this.api.act(this.device.name,{do:`change_target`,axis:this.axis,target:t}))}};customElements.define(`pt-on-the-fly`,x);var S=[`high_speed`,`low_speed`,`acceleration`,`deceleration`];function C(e){return e.filter(({role:e,readable:t,writable:n})=>t&&n&&S.includes(e))}var w=class extends g{static properties={...g.properties,values:{state:!0},axis:{state:!0}};#e=!1;static styles=[c,e`
      .panel {
        height: 100%;
      }
      .fields {
        display: grid;
        grid-template-columns: repeat(auto-fit, minmax(96px, 1fr));
        gap: 8px;
      }
      select {
        width: auto;
      }
    `];constructor(){super(),this.values={},this.axis=null}willUpdate(e){super.willUpdate(e),e.has(`catalog`)&&(this.axis=this.#t()[0]??null)}updated(e){e.has(`active`)&&this.active&&(this.#e=!1),!this.#e&&this.reachable&&this.active&&(this.#e=!0,this.#n())}#t(){return[...new Set(C(this.catalog.parameters).map(({axis:e})=>e))]}async#n(){for(let{id:e}of C(this.catalog.parameters))try{let t=await this.api.parameter(this.device.name,e);this.values={...this.values,[e]:t}}catch(t){t.status!==0&&r(`${e}: ${a(t)}`,`error`),this.#e=t.status!==0;return}}render(){let e=this.#t();if(e.length===0)return n;let t=C(this.catalog.parameters).filter(({axis:e})=>e===this.axis);return f`
      <form class="panel stack" @submit=${this.#a}>
        <div class="row"><h2 class="grow">Speeds and ramps</h2>
          ${e.length>1?f`<select aria-label="Whose" @change=${this.#i}>
                ${e.map(e=>f`<option value=${e??``} ?selected=${e===this.axis}>
                  ${e===null?`all axes`:`axis ${e}`}</option>`)}
              </select>`:n}
        </div>
        <div class="fields">
          ${t.map(e=>f`
            <label title="${e.text} (${e.symbol}, manual ${e.section})">
              ${e.name}${e.unit?` (${e.unit})`:``}
              <input name=${e.id} class="number" type="text" inputmode="decimal" autocomplete="off"
                .value=${this.#r(e)} />
            </label>`)}
        </div>
        <div class="row"><span class="grow"></span>
          <button type="button" ?disabled=${!this.reachable} @click=${()=>this.#n()}>Read</button>
          <button ?disabled=${!this.usable}>Set</button>
        </div>
      </form>
    `}#r(e){let t=this.values[e.id];return t===void 0?``:typeof t==`number`?i(t,e.decimals).replace(`−`,`-`):t}#i(e){this.axis=e.target.value||null}async#a(e){e.preventDefault();let n=new FormData(e.target);for(let e of C(this.catalog.parameters).filter(({axis:e})=>e===this.axis)){let i=String(n.get(e.id)).trim();if(i===``||i===this.#r(e))continue;let a=t(i);if(a===null){r(`${e.name}: “${i}” is not a number.`,`error`);return}if(!await d(()=>this.api.setParameter(this.device.name,e.id,a)))return;this.values={...this.values,[e.id]:a}}}};customElements.define(`pt-ramps`,w);var T=class extends g{watches=[`status`];static styles=[c,e`
      .grid {
        display: grid;
        grid-template-columns: repeat(var(--columns), minmax(0, 1fr));
        gap: var(--gap);
        --columns: 4;
      }
      .grid > * {
        min-width: 0;
      }
      pt-curves {
        grid-column: 1 / -1;
      }
      /* What the last row leaves free is the chart's, if that is two columns. */
      @media (min-width: 1151px) {
        .after-1-of-4 {
          grid-column: 2 / -1;
        }
        .after-2-of-4 {
          grid-column: 3 / -1;
        }
      }
      @media (min-width: 861px) and (max-width: 1150px) {
        .grid {
          --columns: 3;
        }
        .after-1-of-3 {
          grid-column: 2 / -1;
        }
      }
      @media (max-width: 860px) {
        .grid {
          --columns: 2;
        }
      }
      @media (max-width: 600px) {
        .grid {
          --columns: 1;
        }
      }
      .summary {
        min-height: 24px;
        margin-bottom: 8px;
        font-size: 13px;
      }
    `];render(){let{actions:e,axes:t,homing:r}=this.catalog,i=e.includes(`change_speed`)||e.includes(`change_target`),a=t.length+2+ +(r.length>0)+ +!!i;return f`
      ${this.#e()}
      <div class="grid">
        ${t.map(e=>f`
          <pt-axis .axis=${e} ${this.given()}></pt-axis>`)}
        <pt-moves ${this.given()}></pt-moves>
        ${r.length>0?f`<pt-homing ${this.given()}></pt-homing>`:n}
        <pt-ramps ${this.given()}></pt-ramps>
        ${i?f`<pt-on-the-fly ${this.given()}></pt-on-the-fly>`:n}
        <pt-curves compact class="after-${a%4}-of-4 after-${a%3}-of-3" ${this.given()}></pt-curves>
      </div>
    `}#e(){let e=this.live.status;if(!e)return f`<p class="summary muted">Waiting for the first status…</p>`;let t=e.programs.flatMap(({state:e},t)=>e===`idle`?[]:[`program ${t} ${e}`]),n=Object.entries(e.axes).map(([e,t])=>`${e}: ${t.error??(t.speed===0?`standing`:`moving`)}`);return f`
      <div class="row summary">
        <span class="muted">device time <span class="mono">${o(e.seconds)}</span></span>
        ${t.map(e=>f`<span class="badge ${e.endsWith(`error`)?`error`:`busy`}">${e}</span>`)}
        ${e.alarms.map(e=>f`<strong class="error-text">⚠ ${e}</strong>`)}
      </div>
      <div class="visually-hidden" aria-live="polite">${n.join(`, `)}</div>
    `}};customElements.define(`pt-control`,T);