import{_ as e,a as t,b as n,d as r,f as i,g as a,i as o,l as s,n as c,o as l,r as u,t as d,u as f,v as p}from"./index-CEgvhO5r.js";import{t as m}from"./tab-BKgwcDjR.js";import"./curves-CArQwgbo.js";import{t as h}from"./axis-picker-ChV81jjI.js";var g=n`
  .lamp {
    display: inline-flex;
    align-items: center;
    gap: 5px;
    color: var(--muted);
    font-size: 12px;
    white-space: nowrap;
  }
  .lamp::before {
    content: "";
    width: 11px;
    height: 11px;
    border: 2px solid var(--strong-line);
    border-radius: 50%;
  }
  .lamp.on {
    color: var(--text);
    font-weight: 650;
  }
  .lamp.on::before {
    border-color: var(--ok);
    background: var(--ok);
  }
  .lamp.on.hot::before {
    border-color: var(--error);
    background: var(--error);
  }
`;function _(t,n,r,i=!1){return n==null?e:p`
    <span class="lamp ${n?`on`:``} ${i?`hot`:``}" title="${r}: ${n?`on`:`off`}"
      >${t}<span class="visually-hidden">, ${r} ${n?`on`:`off`}</span></span
    >
  `}var v=class extends a{static properties={disabled:{type:Boolean},label:{type:String},held:{state:!0}};static styles=[r,n`
      button {
        width: 100%;
        min-height: 38px;
        font-size: 15px;
        touch-action: none;
        -webkit-touch-callout: none;
      }
      button[aria-pressed="true"] {
        background: var(--accent);
        color: var(--on-accent);
      }
    `];#e=()=>this.#o();#t=()=>{document.hidden&&this.#o()};constructor(){super(),this.disabled=!1,this.label=``,this.held=!1}connectedCallback(){super.connectedCallback(),window.addEventListener(`blur`,this.#e),window.addEventListener(`pagehide`,this.#e),document.addEventListener(`visibilitychange`,this.#t)}disconnectedCallback(){super.disconnectedCallback(),this.#o(),window.removeEventListener(`blur`,this.#e),window.removeEventListener(`pagehide`,this.#e),document.removeEventListener(`visibilitychange`,this.#t)}updated(){this.disabled&&this.#o()}render(){return p`
      <button
        ?disabled=${this.disabled}
        aria-label=${this.label}
        aria-pressed=${this.held}
        @pointerdown=${this.#n}
        @pointerup=${this.#e}
        @pointercancel=${this.#e}
        @lostpointercapture=${this.#e}
        @contextmenu=${e=>e.preventDefault()}
        @keydown=${this.#r}
        @keyup=${this.#i}
        @blur=${this.#e}
      ><slot></slot></button>
    `}#n(e){e.button===0&&(e.currentTarget.setPointerCapture(e.pointerId),this.#a())}#r(e){e.key===`Escape`&&this.#o(),(e.key===` `||e.key===`Enter`)&&(e.preventDefault(),e.repeat||this.#a())}#i(e){(e.key===` `||e.key===`Enter`)&&this.#o()}#a(){this.held||this.disabled||(this.held=!0,this.dispatchEvent(new Event(`begin`)))}#o(){this.held&&(this.held=!1,this.dispatchEvent(new Event(`end`)))}};customElements.define(`pt-hold`,v);var y=class extends m{static properties={...m.properties,axis:{type:String}};watches=[`status`];#e=null;static styles=[r,g,n`
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
    `];render(){let t=this.live.status?.axes[this.axis];if(!t)return p`<section class="panel"><span class="name">${this.axis}</span> –</section>`;let n=e=>this.catalog.actions.includes(e),r=this.axis;return p`
      <section class="panel ${t.error?`error`:``}" aria-label="Axis ${r}">
        <div class="row">
          <span class="name">${r}</span>
          <span class="badge ${d(t)}" data-role="state">${t.state}</span>
          ${t.loop_state&&t.loop_state!==`NA`?p`<span class="badge" title="StepNLoop">${t.loop_state}</span>`:e}
          <span class="grow"></span>
          ${n(`power`)&&t.enabled!==null?p`<button class="small" aria-pressed=${t.enabled} ?disabled=${!this.usable}
                @click=${()=>this.#a({do:`power`,axis:r,on:!t.enabled})}>
                motor ${t.enabled?`on`:`off`}
              </button>`:e}
        </div>
        <div class="position" data-role="position">
          ${u(t.position)} <span class="unit">${this.catalog.units.position}</span>
        </div>
        ${this.#t(t)}
        <div class="lamps">
          ${_(`−L`,t.negative_limit,`negative limit`,!0)}
          ${_(`Home`,t.home,`home switch`)}
          ${_(`+L`,t.positive_limit,`positive limit`,!0)}
          ${_(`Z`,t.index,`encoder index`)}
        </div>
        <div class="error-line">
          ${t.error?p`<strong class="error-text grow">⚠ ${t.error}</strong>`:p`<span class="muted grow">no error</span>`}
          ${n(`clear_error`)?p`<button class="small" ?disabled=${!this.usable||!t.error}
                @click=${()=>this.#a({do:`clear_error`,axis:r})}>Clear</button>`:e}
        </div>
        <div class="jog">
          <pt-hold .disabled=${!this.usable} .label=${`Jog ${r} in negative direction while pressed`}
            @begin=${()=>this.#o(-1)} @end=${this.#c}>◀ −</pt-hold>
          <button ?disabled=${!this.reachable} aria-label="Stop ${r}" title="Stop with deceleration"
            @click=${this.#s}>■</button>
          <pt-hold .disabled=${!this.usable} .label=${`Jog ${r} in positive direction while pressed`}
            @begin=${()=>this.#o(1)} @end=${this.#c}>+ ▶</pt-hold>
        </div>
        ${this.#n(t)} ${this.#r(n)}
      </section>
    `}#t(e){let{units:t}=this.catalog,n=[[`Speed`,e.speed,t.speed],[`Target`,e.target,t.position],[`Encoder`,e.encoder,t.encoder],[`Delta`,e.delta,t.encoder],[`Load`,e.load,``]].filter(([e,t])=>t!==null||e===`Target`||e===`Encoder`);return p`
      <dl>
        ${n.map(([e,t,n])=>p`<dt title=${n}>${e}</dt><dd data-role=${e.toLowerCase()}>${u(t)}</dd>`)}
      </dl>
    `}#n(t){return this.catalog.status_bits.length===0?e:p`
      <details>
        <summary>Status bits · ${t.flags.join(`, `)||`none set`}</summary>
        <ul>
          ${this.catalog.status_bits.map(({name:e,text:n,kind:r})=>p`<li>${_(e,t.flags.includes(e),n||e,r===`error`)}</li>`)}
        </ul>
      </details>
    `}#r(t){let n=[{action:`set_position`,label:`Position counter`,reset:`RP`},{action:`set_encoder`,label:`Encoder counter`,reset:`RE`}].filter(({action:e})=>t(e));return n.length===0?e:p`
      <details>
        <summary>Set counters</summary>
        ${n.map(({action:e,label:t})=>p`
            <form class="set" @submit=${t=>this.#i(t,e)}>
              <label>${t}<input name="value" class="number" type="text" inputmode="numeric" value="0" autocomplete="off" /></label>
              <button ?disabled=${!this.usable}>Set</button>
            </form>
          `)}
      </details>
    `}#i(e,t){e.preventDefault();let n=l(String(new FormData(e.target).get(`value`)));n===null?f(`A counter takes a whole number.`,`error`):this.#a({do:t,axis:this.axis,value:n})}#a(e){return s(()=>this.api.act(this.device.name,e))}#o(e){this.#e=this.#a({do:`jog`,axis:this.axis,direction:e}).finally(()=>{this.#e=null})}#s(){this.locked?s(()=>this.api.stop(this.device.name)):this.#a({do:`stop`,axis:this.axis})}#c(){let e=()=>this.#a({do:`stop`,axis:this.axis}),t=this.#e;e(),t&&t.then(e)}};customElements.define(`pt-axis`,y);var b=class extends m{static properties={...m.properties,axis:{state:!0},mode:{state:!0}};static styles=[r,n`
      .panel {
        height: 100%;
      }
      .about {
        min-height: 2.8em;
        font-size: 13px;
        color: var(--muted);
      }
    `];willUpdate(e){super.willUpdate(e),e.has(`catalog`)&&(this.axis=this.catalog.axes[0]??``,this.mode=this.catalog.homing[0]?.id??0)}render(){let{homing:t,axes:n}=this.catalog,r=t.find(({id:e})=>e===this.mode);return p`
      <div class="panel stack">
        <div class="row"><h2 class="grow">Home</h2>
          ${h(n,this.axis,`home-axis`,e=>this.axis=e)}
        </div>
        <label>Mode
          <select @change=${e=>this.mode=Number(e.target.value)}>
            ${t.map(({id:e,name:t})=>p`<option value=${e} ?selected=${e===this.mode}>${e} · ${t}</option>`)}
          </select>
        </label>
        <p class="about">${r?.text}${r?.section?p` <span>(manual, ${r.section})</span>`:e}</p>
        <div class="row">
          ${[`-`,`+`].map(t=>r?.directions.includes(t)?p`<button class="grow" ?disabled=${!this.usable}
                  aria-label="Home ${this.axis} in ${t===`+`?`positive`:`negative`} direction"
                  @click=${()=>this.#e(t===`+`?1:-1)}>
                  ${t===`-`?`◀ Home −`:`Home + ▶`}
                </button>`:e)}
        </div>
      </div>
    `}#e(e){let{axis:t,mode:n}=this;s(()=>this.api.act(this.device.name,{do:`home`,axis:t,mode:n,direction:e}))}};customElements.define(`pt-homing`,b);var x=class extends m{static properties={...m.properties,chosen:{state:!0},relative:{state:!0}};watches=[`status`];static styles=[r,n`
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
    `];constructor(){super(),this.chosen=new Set,this.relative=!1}willUpdate(e){super.willUpdate(e),e.has(`catalog`)&&(this.chosen=new Set(this.catalog.axes.slice(0,1)))}get#e(){let e=this.live.status?.absolute;return typeof e==`boolean`?!e:this.relative}render(){let{axes:t}=this.catalog,n=this.#e,r=this.chosen.size>1;return p`
      <form class="panel stack" @submit=${this.#r}>
        <div class="row head">
          <h2>Move</h2>
          <div class="mode" role="group" aria-label="Move mode">
            <button type="button" class="small" aria-pressed=${!n} ?disabled=${!this.usable}
              title="Targets are positions" @click=${()=>this.#n(!1)}>ABS</button>
            <button type="button" class="small" aria-pressed=${n} ?disabled=${!this.usable}
              title="Targets are distances" @click=${()=>this.#n(!0)}>INC</button>
          </div>
        </div>
        <div class="targets">
          ${t.map(r=>p`
              <label class="line">
                ${t.length>1?p`<input type="checkbox" aria-label="Move axis ${r}" .checked=${this.chosen.has(r)}
                      @change=${e=>this.#t(r,e.target.checked)} />`:e}
                <strong>${r}</strong>
              </label>
              <input name=${r} class="number" type="text" inputmode="numeric" value="0" autocomplete="off"
                aria-label="${n?`Distance`:`Target`} of axis ${r} in ${this.catalog.units.position}" />
            `)}
        </div>
        <div class="row">
          <button class="primary grow" ?disabled=${!this.usable||this.chosen.size===0}>
            ${r?`Move ${[...this.chosen].join(`, `)} together`:n?`Move by`:`Move to`}
          </button>
          <button type="button" ?disabled=${!this.usable||this.chosen.size===0} title="Move to position 0"
            @click=${this.#i}>Return to 0</button>
        </div>
        <div class="row">
          <button type="button" class="grow" ?disabled=${!this.reachable} title="With deceleration"
            @click=${()=>s(()=>this.api.stop(this.device.name))}>Stop all axes</button>
          ${this.catalog.actions.includes(`abort`)?p`<button type="button" class="danger grow" ?disabled=${!this.usable} title="At once, without deceleration"
                @click=${()=>s(()=>this.api.act(this.device.name,{do:`abort`}))}>Abort</button>`:e}
        </div>
      </form>
    `}#t(e,t){this.chosen=new Set(this.catalog.axes.filter(n=>n===e?t:this.chosen.has(n)))}#n(e){this.relative=e,this.catalog.actions.includes(`set_mode`)&&s(()=>this.api.act(this.device.name,{do:`set_mode`,absolute:!e}))}#r(e){e.preventDefault();let t=new FormData(e.target),n={};for(let e of this.chosen){let r=l(String(t.get(e)));if(r===null){f(`The target of axis ${e} is not a whole number.`,`error`);return}n[e]=r}this.#a(n,this.#e)}#i(){this.#a(Object.fromEntries([...this.chosen].map(e=>[e,0])),!1)}#a(e,t){s(()=>this.api.act(this.device.name,{do:`move`,targets:e,relative:t}))}};customElements.define(`pt-moves`,x);var S=class extends m{static properties={...m.properties,axis:{state:!0}};static styles=[r,n`
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
        flex-basis: 100%;
      }
    `];willUpdate(e){super.willUpdate(e),e.has(`catalog`)&&(this.axis=this.catalog.axes[0]??``)}render(){let{actions:t,axes:n,language:r,units:i}=this.catalog,a=r===`a-script`;return p`
      <div class="panel stack">
        <div class="row"><h2 class="grow">On the fly</h2>
          ${h(n,this.axis,`fly-axis`,e=>this.axis=e)}
        </div>
        ${t.includes(`change_speed`)?p`<form class="fields" @submit=${this.#e}>
              <label title=${i.speed}>Speed <input name="speed" class="number" type="text" inputmode="numeric" value="1000" /></label>
              ${a?p`
                    <label title="ms; empty: as it is">Accel <input name="acceleration" class="number" type="text" inputmode="numeric" /></label>
                    <label title="Speed window, set while the motor stands; empty: as it is">SSPDM
                      <input name="mode" class="number" type="text" inputmode="numeric" />
                    </label>`:e}
              <button ?disabled=${!this.usable}>Set speed</button>
            </form>`:e}
        ${t.includes(`change_target`)?p`<form class="fields" @submit=${this.#t}>
              <label title=${i.position}>Target <input name="target" class="number" type="text" inputmode="numeric" value="1000" /></label>
              <button ?disabled=${!this.usable}>Set target</button>
            </form>`:e}
      </div>
    `}#e(e){e.preventDefault();let t=new FormData(e.target),n={};for(let e of[`speed`,`acceleration`,`mode`]){let r=String(t.get(e)??``).trim();if(r===``&&e!==`speed`)continue;let i=l(r);if(i===null){f(`“${r}” is not a whole number.`,`error`);return}n[e]=i}let{axis:r}=this;s(()=>this.api.act(this.device.name,{do:`change_speed`,axis:r,speed:n.speed,...n}))}#t(e){e.preventDefault();let t=l(String(new FormData(e.target).get(`target`)));t===null?f(`A target is a whole number.`,`error`):s(()=>this.api.act(this.device.name,{do:`change_target`,axis:this.axis,target:t}))}};customElements.define(`pt-on-the-fly`,S);var C=/^(HSPD|LSPD|ACC|DEC|AP4|AP5)$/;function w(e){return e.filter(({id:e,axis:t,readable:n,writable:r})=>{let i=e.replace(/\..*$/,``),a=t!==null&&i.endsWith(t)&&!/\d$/.test(i)?i.slice(0,-t.length):i;return n&&r&&C.test(a)})}var T=class extends m{static properties={...m.properties,values:{state:!0},axis:{state:!0}};#e=!1;static styles=[r,n`
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
    `];constructor(){super(),this.values={},this.axis=null}willUpdate(e){super.willUpdate(e),e.has(`catalog`)&&(this.axis=this.#t()[0]??null)}updated(){!this.#e&&this.reachable&&this.active&&(this.#e=!0,this.#n())}#t(){return[...new Set(w(this.catalog.parameters).map(({axis:e})=>e))]}async#n(){for(let{id:e}of w(this.catalog.parameters))try{let t=await this.api.parameter(this.device.name,e);this.values={...this.values,[e]:t}}catch(t){t.status!==0&&f(`${e}: ${i(t)}`,`error`),this.#e=t.status!==0;return}}render(){let t=this.#t();if(t.length===0)return e;let n=w(this.catalog.parameters).filter(({axis:e})=>e===this.axis);return p`
      <form class="panel stack" @submit=${this.#a}>
        <div class="row"><h2 class="grow">Speeds and ramps</h2>
          ${t.length>1?p`<select aria-label="Whose" @change=${this.#i}>
                ${t.map(e=>p`<option value=${e??``} ?selected=${e===this.axis}>
                  ${e===null?`all axes`:`axis ${e}`}</option>`)}
              </select>`:e}
        </div>
        <div class="fields">
          ${n.map(e=>p`
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
    `}#r(e){let t=this.values[e.id];return t===void 0?``:typeof t==`number`?o(t,e.decimals).replace(`−`,`-`):t}#i(e){this.axis=e.target.value||null}async#a(e){e.preventDefault();let n=new FormData(e.target);for(let e of w(this.catalog.parameters).filter(({axis:e})=>e===this.axis)){let r=String(n.get(e.id)).trim();if(r===``||r===this.#r(e))continue;let i=t(r);if(i===null){f(`${e.name}: “${r}” is not a number.`,`error`);return}if(!await s(()=>this.api.setParameter(this.device.name,e.id,i)))return;this.values={...this.values,[e.id]:i}}}};customElements.define(`pt-ramps`,T);var E=class extends m{watches=[`status`];static styles=[r,n`
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
    `];render(){let{actions:t,axes:n,homing:r}=this.catalog,i=t.includes(`change_speed`)||t.includes(`change_target`),a=n.length+2+ +(r.length>0)+ +!!i;return p`
      ${this.#e()}
      <div class="grid">
        ${n.map(e=>p`
          <pt-axis .axis=${e} ${this.given()}></pt-axis>`)}
        <pt-moves ${this.given()}></pt-moves>
        ${r.length>0?p`<pt-homing ${this.given()}></pt-homing>`:e}
        <pt-ramps ${this.given()}></pt-ramps>
        ${i?p`<pt-on-the-fly ${this.given()}></pt-on-the-fly>`:e}
        <pt-curves compact class="after-${a%4}-of-4 after-${a%3}-of-3" ${this.given()}></pt-curves>
      </div>
    `}#e(){let e=this.live.status;if(!e)return p`<p class="summary muted">Waiting for the first status…</p>`;let t=e.programs.flatMap(({state:e},t)=>e===`idle`?[]:[`program ${t} ${e}`]),n=Object.entries(e.axes).map(([e,t])=>`${e}: ${t.error??(t.speed===0?`standing`:`moving`)}`);return p`
      <div class="row summary">
        <span class="muted">device time <span class="mono">${c(e.seconds)}</span></span>
        ${t.map(e=>p`<span class="badge ${e.endsWith(`error`)?`error`:`busy`}">${e}</span>`)}
        ${e.alarms.map(e=>p`<strong class="error-text">⚠ ${e}</strong>`)}
      </div>
      <div class="visually-hidden" aria-live="polite">${n.join(`, `)}</div>
    `}};customElements.define(`pt-control`,E);